// Charts and the drawing of the pair, as SVG.
'use strict';

const SVG = 'http://www.w3.org/2000/svg';
const WIDE = 460, HIGH = 250;
const LEFT = 52, RIGHT = 10, TOP = 24, BOTTOM = 36;

function element(name, attributes, text) {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes || {})) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  return made;
}

// A step of 1, 2 or 5 times a power of ten that divides `span` into about `count` parts.
function evenStep(span, count) {
  const raw = span / count, power = 10 ** Math.floor(Math.log10(raw));
  return power * (raw / power >= 5 ? 5 : raw / power >= 2 ? 2 : 1);
}

// Number with so many digits, without an exponent where it need not have one.
function digits(value, count) {
  if (value === null || !Number.isFinite(value)) return '–';
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e7)) return value.toExponential(count - 1).replace('e+', 'e');
  const places = size === 0 ? 0 : Math.max(0, count - 1 - Math.floor(Math.log10(size)));
  return value.toFixed(Math.min(places, 12));
}

// One chart: { name, x, y: titles, range: least span of y, from zero?, most: greatest y, zone: [[from, to]], series: [{ x, y, kind }] }.
function drawChart(figure, chart) {
  const all = chart.series.filter((s) => s.x.length > 1);
  const xs = all.flatMap((s) => [s.x[0], s.x[s.x.length - 1]]);
  if (chart.within) xs.splice(0, xs.length, ...chart.within);
  const [x0, x1] = [Math.min(...xs), Math.max(...xs)];
  let low = chart.fromZero ? 0 : Infinity, high = -Infinity;
  for (const s of all) {
    for (let i = 0; i < s.y.length; i++) {
      if (s.x[i] < x0 || s.x[i] > x1) continue;
      if (s.y[i] < low) low = s.y[i];
      if (s.y[i] > high) high = s.y[i];
    }
  }
  if (chart.most) high = Math.min(high, chart.most);
  if (!(high > low)) high = low + 1;
  const step = evenStep(high - low, 4);
  low = Math.floor(low / step + 1e-9) * step;
  high = Math.ceil(high / step - 1e-9) * step;
  const last = high;
  // A curve along the frame is seen.
  high += 0.03 * (high - low);
  const px = (x) => LEFT + (WIDE - LEFT - RIGHT) * (x - x0) / (x1 - x0);
  const py = (y) => HIGH - BOTTOM - (HIGH - TOP - BOTTOM) * (y - low) / (high - low);
  const svg = element('svg', { viewBox: `0 0 ${WIDE} ${HIGH}`, role: 'img', 'aria-label': chart.name });
  const clip = `${figure.id}-clip`;
  const inside = element('clipPath', { id: clip });
  inside.append(element('rect', { x: LEFT, y: TOP, width: WIDE - LEFT - RIGHT, height: HIGH - TOP - BOTTOM }));
  svg.append(inside);
  for (const [from, to] of chart.zones || []) {
    const [a, b] = [Math.max(px(from), LEFT), Math.min(px(to), WIDE - RIGHT)];
    if (b > a) svg.append(element('rect', { class: 'zone', x: a, y: TOP, width: b - a, height: HIGH - TOP - BOTTOM }));
  }
  for (let y = low; y <= last + 0.01 * step; y += step) {
    svg.append(element('line', { class: 'grid', x1: LEFT, x2: WIDE - RIGHT, y1: py(y), y2: py(y) }));
    const places = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
    svg.append(element('text', { x: LEFT - 6, y: py(y) + 4, 'text-anchor': 'end' }, (Math.abs(y) < 1e-9 * step ? 0 : y).toFixed(places)));
  }
  const stepX = evenStep(x1 - x0, 5);
  for (let x = Math.ceil(x0 / stepX - 1e-9) * stepX; x <= x1 + 1e-9 * stepX; x += stepX) {
    const places = Math.max(0, -Math.floor(Math.log10(stepX) + 1e-9));
    svg.append(element('line', { class: 'grid', x1: px(x), x2: px(x), y1: TOP, y2: HIGH - BOTTOM }));
    svg.append(element('text', { x: px(x), y: HIGH - BOTTOM + 15, 'text-anchor': 'middle' }, x.toFixed(places)));
  }
  svg.append(element('rect', { class: 'frame', x: LEFT, y: TOP, width: WIDE - LEFT - RIGHT, height: HIGH - TOP - BOTTOM }));
  const curves = element('g', { 'clip-path': `url(#${clip})` });
  for (const s of all) {
    let d = '';
    for (let i = 0; i < s.x.length; i++) d += `${d ? 'L' : 'M'}${px(s.x[i]).toFixed(1)} ${py(s.y[i]).toFixed(1)}`;
    curves.append(element('path', { class: s.kind, d }));
  }
  svg.append(curves);
  svg.append(element('text', { class: 'name', x: LEFT, y: 15 }, chart.name));
  svg.append(element('text', { x: WIDE - RIGHT, y: 15, 'text-anchor': 'end' }, chart.y));
  svg.append(element('text', { x: WIDE - RIGHT, y: HIGH - 6, 'text-anchor': 'end' }, chart.x));
  figure.replaceChildren(svg);
}

// The pair around the pitch point, to scale.
function drawPair(figure, drawing) {
  const [cx, cy] = drawing.middle, side = drawing.half_side_mm;
  const width = WIDE, height = HIGH;
  const scale = 1.2 * height / (2 * side);
  const at = ([x, y]) => [(x - cx) * scale + width / 2, height / 2 - (y - cy) * scale];
  const line = (points) => points.map((p, i) => `${i ? 'L' : 'M'}${at(p).map((v) => v.toFixed(2)).join(' ')}`).join('');
  const svg = element('svg', { viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': 'The pair in mesh, to scale' });
  for (const gear of ['pinion', 'wheel']) {
    for (const piece of drawing.outline[gear]) svg.append(element('path', { class: `tooth ${gear}`, d: line(piece) }));
    const [x, y] = at(drawing.axis[gear]);
    svg.append(element('circle', { class: 'circle', cx: x, cy: y, r: Math.abs(drawing.working_pitch_radius_mm[gear]) * scale, fill: 'none' }));
  }
  const points = drawing.path_of_contact;
  svg.append(element('path', { class: 'path', d: line(points.map((p) => p[1])) }));
  for (const [name, place] of points) {
    const [x, y] = at(place);
    svg.append(element('circle', { class: 'point', cx: x, cy: y, r: 3 }));
    svg.append(element('text', { x: x + 6, y: y - 5 }, name));
  }
  svg.append(element('text', { class: 'name', x: 8, y: 15 }, 'The pair in mesh, to scale'));
  svg.append(element('text', { x: 8, y: height - 8 }, 'path of contact A to E; pitch circles dashed'));
  figure.replaceChildren(svg);
}
