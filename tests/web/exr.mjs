// Images as EXR files, for maps of known functions.

const text = (value) => Buffer.from(`${value}\0`, 'latin1');
const numbers = (type, ...values) => {
    const bytes = Buffer.alloc(4 * values.length);
    values.forEach((value, i) => type === 'f' ? bytes.writeFloatLE(value, 4 * i) : bytes.writeInt32LE(value, 4 * i));
    return bytes;
};
const attribute = (name, type, value) => Buffer.concat([text(name), text(type), numbers('i', value.length), value]);

/** An EXR file of side × side texels [r, g, b] without compression: 32-bit floats, alpha 1. */
export function exr(side, texelOf) {
    // Channels are in the order of their names.
    const channels = Buffer.concat([...'ABGR'].map((name) =>
        Buffer.concat([text(name), numbers('i', 2, 0, 1, 1)])).concat(Buffer.alloc(1)));
    const box = numbers('i', 0, 0, side - 1, side - 1);
    const head = Buffer.concat([numbers('i', 20000630, 2), attribute('channels', 'chlist', channels),
        attribute('compression', 'compression', Buffer.alloc(1)), attribute('dataWindow', 'box2i', box),
        attribute('displayWindow', 'box2i', box), attribute('lineOrder', 'lineOrder', Buffer.alloc(1)),
        attribute('pixelAspectRatio', 'float', numbers('f', 1)),
        attribute('screenWindowCenter', 'v2f', numbers('f', 0, 0)),
        attribute('screenWindowWidth', 'float', numbers('f', 1)), Buffer.alloc(1)]);
    const row = 8 + 16 * side, start = head.length + 8 * side;
    const file = Buffer.alloc(start + row * side);
    head.copy(file);
    for (let y = 0; y < side; ++y) {
        file.writeBigUInt64LE(BigInt(start + y * row), head.length + 8 * y);
        file.writeInt32LE(y, start + y * row);
        file.writeInt32LE(16 * side, start + y * row + 4);
        const line = new Float32Array(4 * side).fill(1, 0, side); // alpha
        for (let x = 0; x < side; ++x)
            texelOf(x, y).forEach((value, channel) => { line[(3 - channel) * side + x] = value; });
        Buffer.from(line.buffer).copy(file, start + y * row + 8);
    }
    return file;
}
