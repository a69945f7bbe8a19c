// Exposure of the scene: that of the bake for its lamps, and one that follows the hour for daylight.

const greyLight = 0.36; // exposure × illuminance of a grey surface, albedo 0.5, that shows as mid grey, 0.18
const adaptation = 0.7; // share of the change of daylight, in stops, that exposure makes up for

// Illuminance to expose for [lx], by light and what it usually is: noon stays brighter than dusk.
const lightFor = (light, usual) => usual && usual * (light / usual) ** adaptation;

/** Exposure of a bake in its present light. [1/lx] */
export function exposureOf({ exposure, daylight, map }) {
    if (!daylight) return exposure;
    const ofLamps = map.hasLamps ? greyLight / exposure : 0; // [lx]
    const light = lightFor(daylight.now?.mean ?? 0, daylight.hours.mean) + lightFor(ofLamps * map.lampLevel, ofLamps);
    return greyLight / (light || ofLamps || daylight.hours.mean || 1);
}
