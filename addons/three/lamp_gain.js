// The factor of a lamp's map for a dimming factor and a colour.

const luxShares = [0.2126, 0.7152, 0.0722];
const leastChannel = 0.01; // of a lamp's colour: below, its map has too little light to be recoloured

const weighed = (rgb) => rgb.reduce((sum, value, channel) => sum + value * luxShares[channel], 0);

/**
 * Factor of a lamp's map. baked: the colour of its light, its largest channel 1; chosen: another colour, which keeps the
 * lamp's illuminance, or null. All in linear RGB.
 */
export function lampGain(baked, factor, chosen) {
    if (!chosen) return [factor, factor, factor];
    const ratio = chosen.map((value, channel) => baked[channel] < leastChannel ? 1 : value / baked[channel]);
    const lux = weighed(ratio.map((value, channel) => value * baked[channel]));
    return ratio.map((value) => lux > 0 ? factor * value * weighed(baked) / lux : 0);
}
