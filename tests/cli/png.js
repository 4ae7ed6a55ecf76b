// Reads a PNG that sgm wrote. For the whole picture or a rectangle of it, prints the mean of red + green + blue
// (0..765), and the number of pixels where this sum is below 240.
//
//   node png.js FILE [X Y WIDE HIGH]
const fs = require('fs'), zlib = require('zlib');
const png = fs.readFileSync(process.argv[2]), parts = [];
for (let at = 8; at < png.length; ) {
  const size = png.readUInt32BE(at);
  if (png.toString('latin1', at + 4, at + 8) === 'IDAT') parts.push(png.subarray(at + 8, at + 8 + size));
  at += size + 12;
}
const wide = png.readUInt32BE(16), high = png.readUInt32BE(20), rows = zlib.inflateSync(Buffer.concat(parts));
const line = 4 * wide, pixels = Buffer.alloc(line * high);
const paeth = (a, b, c) => {
  const p = a + b - c, pa = Math.abs(p - a), pb = Math.abs(p - b), pc = Math.abs(p - c);
  return pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
};
for (let y = 0; y < high; ++y) {
  const filter = rows[y * (line + 1)];
  for (let x = 0; x < line; ++x) {
    const a = x < 4 ? 0 : pixels[y * line + x - 4], b = y ? pixels[(y - 1) * line + x] : 0;
    const c = x < 4 || !y ? 0 : pixels[(y - 1) * line + x - 4];
    pixels[y * line + x] = rows[y * (line + 1) + 1 + x] + [0, a, b, (a + b) >> 1, paeth(a, b, c)][filter];
  }
}
const [left, top, across, down] = process.argv.length > 3 ? process.argv.slice(3).map(Number) : [0, 0, wide, high];
let sum = 0, dark = 0;
for (let y = top; y < top + down; ++y) {
  for (let x = left; x < left + across; ++x) {
    const i = y * line + 4 * x, light = pixels[i] + pixels[i + 1] + pixels[i + 2];
    sum += light;
    dark += light < 240;
  }
}
console.log(Math.round(sum / (across * down)), dark);
