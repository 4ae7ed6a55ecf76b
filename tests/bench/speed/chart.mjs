// Draws two kinds of charts as SVG: bars of a measured value relative to its target, and curves on logarithmic axes.

const escaped = (s) => String(s).replace(/&/g, '&amp;').replace(/</g, '&lt;').replace(/>/g, '&gt;');
export const short = (x) => String(+x.toPrecision(3));
const colours = ['#1b6ca8', '#c8553d', '#3a7d44', '#8a5a9e', '#b8860b', '#4a4a4a'];

function page(width, height, body) {
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" font-family="sans-serif" ` +
    `font-size="12" fill="#111"><rect width="100%" height="100%" fill="#fff"/>${body}</svg>\n`;
}

/// Draws a bar chart. rows: { name, reached, asked, unit, atMost }. A bar's length is `reached` divided by the target
/// `asked`, or the inverse if the target is an upper bound (atMost). A bar that reaches the dashed line at 1 meets its
/// target.
export function bars(title, rows) {
  const left = 500, unit = 150, height = 24, top = 44, most = 3.2;
  const drawn = rows.map((row, i) => {
    const share = row.atMost ? row.asked / row.reached : row.reached / row.asked;
    const y = top + i * height;
    return `<text x="${left - 8}" y="${y + 14}" text-anchor="end">${escaped(row.name)}</text>` +
      `<rect x="${left}" y="${y + 3}" width="${Math.min(most, share) * unit}" height="15" ` +
      `fill="${share >= 1 ? '#3a7d44' : '#c8553d'}"/>` +
      `<text x="${left + Math.max(1, Math.min(most, share)) * unit + 8}" y="${y + 14}">` +
      `${short(row.reached)}${escaped(row.unit)} (${row.atMost ? 'at most' : 'at least'} ${row.asked}${escaped(row.unit)})</text>`;
  });
  const end = top + rows.length * height;
  return page(left + most * unit + 230, end + 12,
    `<text x="12" y="20" font-size="14">${escaped(title)}</text>${drawn.join('')}` +
    `<path d="M${left + unit} ${top - 8}V${end}" stroke="#111" stroke-dasharray="4 3"/>`);
}

/// Draws one chart of curves for each panel; panels: { title, x, y, lines: [{ name, points: [[x, y]], exponent }] }.
export function curves(panels) {
  const wide = 330, tall = 280, left = 58, bottom = 44, top = 34, columns = 3;
  const drawn = panels.map((panel, number) => {
    const ox = (number % columns) * (wide + 24), oy = Math.floor(number / columns) * (tall + 24);
    const all = panel.lines.flatMap((line) => line.points);
    const range = (k) => {
      const values = all.map((p) => Math.log10(p[k]));
      const lo = Math.min(...values), hi = Math.max(...values), pad = Math.max(0.08, 0.06 * (hi - lo));
      // The y axis gets extra room at the top for the names of the curves.
      return [lo - pad, hi + pad + (k === 1 ? (0.14 + 0.09 * panel.lines.length) * Math.max(0.3, hi - lo) : 0)];
    };
    const [x0, x1] = range(0), [y0, y1] = range(1);
    const px = (x) => ox + left + (Math.log10(x) - x0) / (x1 - x0) * (wide - left - 12);
    const py = (y) => oy + tall - bottom - (Math.log10(y) - y0) / (y1 - y0) * (tall - bottom - top);
    const ticks = (lo, hi) => {
      const found = [];
      for (let e = Math.floor(lo); e <= hi; ++e)
        for (const m of hi - lo > 2.5 ? [1] : hi - lo > 1 ? [1, 2, 5] : [1, 1.5, 2, 3, 4, 5, 7]) if (Math.log10(m) + e >= lo && Math.log10(m) + e <= hi) found.push(m * 10 ** e);
      return found;
    };
    const xs = [...new Set(all.map((p) => p[0]))].sort((a, b) => a - b);
    const grid = ticks(y0, y1).map((y) => `<path d="M${ox + left} ${py(y)}H${ox + wide - 12}" stroke="#ddd"/>` +
      `<text x="${ox + left - 6}" y="${py(y) + 4}" text-anchor="end">${short(y)}</text>`).join('') +
      xs.map((x) => `<path d="M${px(x)} ${oy + top}V${oy + tall - bottom}" stroke="#eee"/>` +
        `<text x="${px(x)}" y="${oy + tall - bottom + 16}" text-anchor="middle">${x >= 1e5 ? x.toExponential(0).replace('+', '') : x}</text>`).join('');
    const lines = panel.lines.map((line, i) => {
      const colour = colours[i % colours.length];
      const path = line.points.map((p, k) => `${k ? 'L' : 'M'}${px(p[0]).toFixed(1)} ${py(p[1]).toFixed(1)}`).join('');
      return `<path d="${path}" fill="none" stroke="${colour}" stroke-width="2"/>` +
        line.points.map((p) => `<circle cx="${px(p[0])}" cy="${py(p[1])}" r="3" fill="${colour}"/>`).join('') +
        `<text x="${ox + left + 8}" y="${oy + top + 14 + 15 * i}" fill="${colour}">${escaped(line.name)}: exponent ${line.exponent.toFixed(2)}</text>`;
    }).join('');
    return `<text x="${ox + left}" y="${oy + 20}" font-size="13">${escaped(panel.title)}</text>${grid}${lines}` +
      `<text x="${ox + (left + wide) / 2}" y="${oy + tall - 8}" text-anchor="middle">${escaped(panel.x)}</text>` +
      `<text transform="translate(${ox + 12} ${oy + tall / 2}) rotate(-90)" text-anchor="middle">${escaped(panel.y)}</text>`;
  });
  return page(columns * (wide + 24), Math.ceil(panels.length / columns) * (tall + 24), drawn.join(''));
}

/// Returns the slope of log y over log x by least squares: the exponent of a power law through the points.
export function exponent(points) {
  const x = points.map((p) => Math.log(p[0])), y = points.map((p) => Math.log(p[1]));
  const mean = (v) => v.reduce((a, b) => a + b, 0) / v.length;
  const mx = mean(x), my = mean(y);
  return x.reduce((sum, v, i) => sum + (v - mx) * (y[i] - my), 0) / x.reduce((sum, v) => sum + (v - mx) ** 2, 0);
}
