// SPDX-License-Identifier: BSD-3-Clause
// Draws the flights of the page that it stands in: no library, no network.
'use strict';
const data = JSON.parse(document.getElementById('data').textContent);
const palette = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9', '#7a5cad', '#444444'];
const policies = [...new Set(data.runs.map(run => run.policy))];
const seeds = [...new Set(data.runs.map(run => run.seed))];
const colour = policy => palette[policies.indexOf(policy) % palette.length];
const state = { seed: seeds[0], hidden: new Set(), time: null };
const shown = () => data.runs.filter(run => run.seed === state.seed && !state.hidden.has(run.policy));

const charts = [
  { title: 'Map resolution', unit: 'm', lines: [{ key: 'resolution', step: true }], digits: 2 },
  { title: 'Latency bound', unit: 's', lines: [{ key: 'latency' }], digits: 2 },
  { title: 'Speed', unit: 'm/s', lines: [{ key: 'limit', dash: [4, 3], name: 'limit' }, { key: 'speed' }], digits: 2 },
  { title: 'Rotor power', unit: 'W', lines: [{ key: 'rotor' }], digits: 0 },
  { title: 'Computer power', unit: 'W', lines: [{ key: 'computer' }], digits: 1 },
  { title: 'Battery', unit: '%', lines: [{ key: 'battery' }], digits: 1, top: 100 },
  { title: 'Coverage', unit: '%', lines: [{ key: 'coverage' }], digits: 1, top: 100 },
].filter(chart => data.runs.some(run => chart.lines.some(line => (run.series[line.key] || []).some(v => v !== null))));
for (const chart of charts) for (const run of data.runs) for (const line of chart.lines)
  run.series[line.key] = run.series[line.key] || [];

/* A canvas at the screen's own resolution; drawing is in CSS pixels. */
function fit(canvas, height) {
  const width = canvas.clientWidth, scale = window.devicePixelRatio || 1;
  canvas.width = width * scale;
  canvas.height = height * scale;
  canvas.style.height = height + 'px';
  const pen = canvas.getContext('2d');
  pen.setTransform(scale, 0, 0, scale, 0, 0);
  pen.clearRect(0, 0, width, height);
  pen.font = '12px system-ui, "Segoe UI", "DejaVu Sans", sans-serif';
  return [pen, width, height];
}
function ticks(low, high, about) {
  const raw = (high - low) / about, power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map(m => m * power).find(s => s >= raw);
  const all = [];
  for (let v = Math.ceil(low / step) * step; v <= high + step * 1e-9; v += step) all.push(+v.toPrecision(12));
  return all;
}
const indexAt = (series, time) => {
  let low = 0, high = series.t.length - 1;
  while (low < high) { const mid = (low + high + 1) >> 1; series.t[mid] <= time ? low = mid : high = mid - 1; }
  return low;
};
const endTime = runs => Math.max(1, ...runs.map(run => run.series.t[run.series.t.length - 1] || 0));
const failed = run => run.status !== 'succeeded';
const wordFor = run => run.failure !== 'none' ? run.failure.replace('_', ' ') : run.status;

function cross(pen, x, y, ink) {
  for (const [width, style] of [[5, '#fff'], [2.5, ink]]) {
    pen.lineWidth = width; pen.strokeStyle = style; pen.setLineDash([]);
    pen.beginPath();
    pen.moveTo(x - 5, y - 5); pen.lineTo(x + 5, y + 5); pen.moveTo(x - 5, y + 5); pen.lineTo(x + 5, y - 5);
    pen.stroke();
  }
}

/* Time plots. */
const left = 52, right = 14;
function drawChart(chart) {
  const runs = shown(), [pen, width, height] = fit(chart.canvas, 148);
  const end = endTime(runs), bottom = height - 22, roof = 8;
  let top = chart.top || 0;
  for (const run of runs) for (const line of chart.lines) for (const v of run.series[line.key]) if (v > top) top = v;
  const marks = ticks(0, (top || 1) * (chart.top ? 1 : 1.06), 5);
  const high = Math.max((top || 1) * (chart.top ? 1 : 1.06), marks[marks.length - 1]);
  const X = t => left + (width - left - right) * t / end, Y = v => bottom - (bottom - roof) * v / high;
  chart.timeAt = x => (x - left) / (width - left - right) * end;
  pen.lineWidth = 1; pen.strokeStyle = '#e6ebef'; pen.fillStyle = '#6b7a88'; pen.textBaseline = 'middle';
  pen.textAlign = 'right';
  for (const v of marks) {
    pen.beginPath(); pen.moveTo(left, Math.round(Y(v)) + .5); pen.lineTo(width - right, Math.round(Y(v)) + .5); pen.stroke();
    pen.fillText(String(v), left - 7, Y(v));
  }
  pen.textAlign = 'center'; pen.textBaseline = 'top';
  const times = ticks(0, end, Math.max(3, width / 110));
  times.forEach((t, i) => pen.fillText(t + (i === times.length - 1 ? ' s' : ''), X(t), bottom + 6));
  for (const run of runs) for (const line of chart.lines) {
    pen.strokeStyle = colour(run.policy); pen.lineWidth = line.dash ? 1 : 1.6; pen.setLineDash(line.dash || []);
    pen.beginPath();
    let open = false, before = 0;
    run.series[line.key].forEach((v, i) => {
      if (v === null) { open = false; return; }
      if (open && line.step) pen.lineTo(X(run.series.t[i]), Y(before));
      open ? pen.lineTo(X(run.series.t[i]), Y(v)) : pen.moveTo(X(run.series.t[i]), Y(v));
      open = true; before = v;
    });
    pen.stroke();
    if (!line.dash && failed(run) && run.series.t.length) {
      const last = run.series.t.length - 1;
      cross(pen, X(run.series.t[last]), Y(run.series[line.key][last] || 0), colour(run.policy));
    }
  }
  pen.setLineDash([]);
  if (state.time !== null) {
    pen.strokeStyle = '#9aa7b3'; pen.lineWidth = 1;
    pen.beginPath(); pen.moveTo(X(state.time), roof); pen.lineTo(X(state.time), bottom); pen.stroke();
  }
}

/* Top view: `view` is the place in the middle and the pixels per metre. */
const map = document.getElementById('map');
let view = null, drawn = null;
function fitView() {
  const world = data.worlds[(shown()[0] || data.runs[0]).world];
  const w = world.max[0] - world.min[0], h = world.max[1] - world.min[1];
  const scale = Math.min((map.clientWidth - 20) / w, 520 / h);
  view = { x: (world.max[0] + world.min[0]) / 2, y: (world.max[1] + world.min[1]) / 2, scale,
           height: Math.max(180, h * scale + 56) };
}
/* A raster is painted once into a canvas of its own, a pixel a cell. */
function rasterImage(world) {
  const { rows } = world.raster;
  const columns = Math.max(1, ...rows.map(r => r.length ? r[r.length - 2] + r[r.length - 1] : 0));
  const image = document.createElement('canvas');
  image.width = columns; image.height = rows.length;
  const pen = image.getContext('2d');
  pen.fillStyle = '#97a3af';
  rows.forEach((runs, y) => { for (let i = 0; i < runs.length; i += 2) pen.fillRect(runs[i], rows.length - 1 - y, runs[i + 1], 1); });
  return image;
}
function drawSolid(pen, world, X, Y) {
  pen.fillStyle = '#97a3af';
  if (world.raster) {
    world.image = world.image || rasterImage(world);
    const cell = world.raster.cell_m * view.scale;
    pen.imageSmoothingEnabled = false;
    pen.drawImage(world.image, X(world.raster.x_m), Y(world.raster.y_m) - world.image.height * cell,
                  world.image.width * cell, world.image.height * cell);
  }
  for (const [x0, y0, x1, y1] of world.boxes || [])
    pen.fillRect(X(x0), Y(y1), Math.max(1, (x1 - x0) * view.scale), Math.max(1, (y1 - y0) * view.scale));
  for (const [x, y, r] of world.pillars) {
    pen.beginPath(); pen.arc(X(x), Y(y), Math.max(1, r * view.scale), 0, 2 * Math.PI); pen.fill();
  }
}
function drawPlace(pen, x, y, name) {
  pen.fillStyle = '#fff'; pen.strokeStyle = '#22303c'; pen.lineWidth = 2;
  pen.beginPath(); pen.arc(x, y, 5, 0, 2 * Math.PI); pen.fill(); pen.stroke();
  label(pen, x, y - 13, name, '#22303c');
}
function label(pen, x, y, text, ink) {
  pen.textAlign = 'center'; pen.textBaseline = 'middle'; pen.lineWidth = 3; pen.strokeStyle = '#fff';
  x = Math.max(pen.measureText(text).width / 2 + 2, Math.min(map.clientWidth - pen.measureText(text).width / 2 - 2, x));
  pen.strokeText(text, x, y); pen.fillStyle = ink; pen.fillText(text, x, y);
}
/* Pictures of the ground: darker where more of them overlap. Until the time under the pointer, if any. */
function drawCovered(pen, run, X, Y) {
  const far = !run.footprint ? 0 : state.time === null ? run.footprint.length
    : run.footprint.filter(picture => picture[8] <= state.time).length;
  pen.fillStyle = colour(run.policy); pen.globalAlpha = .07;
  for (const corners of (run.footprint || []).slice(0, far)) {
    pen.beginPath();
    for (let i = 0; i < 8; i += 2) i ? pen.lineTo(X(corners[i]), Y(corners[i + 1])) : pen.moveTo(X(corners[0]), Y(corners[1]));
    pen.fill();
  }
  pen.globalAlpha = 1;
  pen.strokeStyle = '#22303c'; pen.lineWidth = 1; pen.setLineDash([5, 4]);
  for (const [x0, y0, x1, y1] of run.area || []) pen.strokeRect(X(x0), Y(y1), (x1 - x0) * view.scale, (y1 - y0) * view.scale);
  pen.setLineDash([]);
}
function drawPath(pen, run, X, Y) {
  const { x, y, t } = run.series;
  pen.strokeStyle = colour(run.policy); pen.lineWidth = 1.8; pen.lineJoin = 'round';
  pen.beginPath();
  x.forEach((_, i) => i ? pen.lineTo(X(x[i]), Y(y[i])) : pen.moveTo(X(x[i]), Y(y[i])));
  pen.stroke();
  if (state.time !== null && x.length) {
    const i = indexAt(run.series, state.time);
    pen.fillStyle = colour(run.policy);
    pen.beginPath(); pen.arc(X(x[i]), Y(y[i]), 5, 0, 2 * Math.PI); pen.fill();
  }
}
/* Whom a search took for a person: ring or cross, a real one or not. */
function drawSightings(pen, run, X, Y) {
  const seen = (run.sighting || []).filter(s => state.time === null || s[6] <= state.time);
  for (const [x, y, real] of seen) {
    if (!real) { cross(pen, X(x), Y(y), '#b00020'); continue; }
    pen.strokeStyle = '#009e73'; pen.lineWidth = 3;
    pen.beginPath(); pen.arc(X(x), Y(y), 9, 0, 2 * Math.PI); pen.stroke();
  }
  const found = seen.find(s => s[2]);
  if (found) label(pen, X(found[0]), Y(found[1]) - 18, `found at ${found[6].toFixed(0)} s`, '#00694d');
}
function drawScale(pen, width, height) {
  const most = width / view.scale / 4, power = 10 ** Math.floor(Math.log10(most));
  const metres = [5, 2, 1].map(m => m * power).find(m => m <= most), x = width - 16 - metres * view.scale, y = height - 14;
  pen.strokeStyle = '#22303c'; pen.lineWidth = 1.5;
  pen.beginPath(); pen.moveTo(x, y - 4); pen.lineTo(x, y); pen.lineTo(width - 16, y); pen.lineTo(width - 16, y - 4); pen.stroke();
  label(pen, (x + width - 16) / 2, y - 10, metres + ' m', '#22303c');
}
function drawMap() {
  const runs = shown(), world = data.worlds[(runs[0] || data.runs[0]).world];
  if (drawn !== world || !view) { drawn = world; fitView(); }
  const [pen, width, height] = fit(map, view.height);
  const X = x => width / 2 + (x - view.x) * view.scale, Y = y => height / 2 - (y - view.y) * view.scale;
  pen.fillStyle = '#fbfcfd'; pen.strokeStyle = '#dfe5ea'; pen.lineWidth = 1;
  pen.fillRect(X(world.min[0]), Y(world.max[1]), X(world.max[0]) - X(world.min[0]), Y(world.min[1]) - Y(world.max[1]));
  pen.strokeRect(X(world.min[0]), Y(world.max[1]), X(world.max[0]) - X(world.min[0]), Y(world.min[1]) - Y(world.max[1]));
  drawSolid(pen, world, X, Y);
  for (const run of runs) drawCovered(pen, run, X, Y);
  for (const run of runs) drawPath(pen, run, X, Y);
  for (const run of runs) drawSightings(pen, run, X, Y);
  drawPlace(pen, X(world.start[0]), Y(world.start[1]), 'start');
  if (String(world.goal) !== String(world.start)) drawPlace(pen, X(world.goal[0]), Y(world.goal[1]), 'goal');
  runs.filter(failed).forEach(run => {
    const last = run.series.x.length - 1;
    if (last < 0) return;
    const x = X(run.series.x[last]), y = Y(run.series.y[last]);
    cross(pen, x, y, colour(run.policy));
    label(pen, x, y + 16, run.policy + ': ' + wordFor(run), colour(run.policy));
  });
  drawScale(pen, width, height);
}

function drawAll() { drawMap(); charts.forEach(drawChart); }

/* What the reader turns: seed, policies, time under the pointer, the map's view. */
const readout = document.getElementById('readout');
function showReadout(event, chart) {
  const lines = shown().map(run => {
    const i = indexAt(run.series, state.time);
    const gone = state.time > run.series.t[run.series.t.length - 1];
    const values = chart.lines.slice().reverse().map(line => {
      const v = run.series[line.key][i];
      return (line.name ? line.name + ' ' : '') + (v === null ? '-' : v.toFixed(chart.digits) + ' ' + chart.unit);
    });
    return `<span class="swatch" style="background:${colour(run.policy)}"></span> ` + (gone ? 'ended' : values.join(', '));
  });
  readout.innerHTML = `${state.time.toFixed(0)} s<br>` + lines.join('<br>');
  readout.style.display = 'block';
  const flip = event.clientX > window.innerWidth - 220;
  readout.style.left = event.clientX + (flip ? -readout.offsetWidth - 14 : 14) + 'px';
  readout.style.top = event.clientY + 14 + 'px';
}
function makeCharts() {
  for (const chart of charts) {
    const box = document.createElement('div');
    box.className = 'chart';
    const names = chart.lines.filter(l => l.name).map(l => (l.dash ? 'dashed: ' : 'solid: ') + l.name);
    box.innerHTML = `<h2>${chart.title} <span class="hint">${chart.unit}${names.length ? '; ' + names.join(', ') : ''}</span></h2><canvas></canvas>`;
    chart.canvas = box.querySelector('canvas');
    chart.canvas.addEventListener('pointermove', event => {
      const time = chart.timeAt(event.offsetX);
      state.time = time >= 0 && time <= endTime(shown()) ? time : null;
      state.time === null ? readout.style.display = 'none' : showReadout(event, chart);
      drawAll();
    });
    chart.canvas.addEventListener('pointerleave', () => { state.time = null; readout.style.display = 'none'; drawAll(); });
    document.getElementById('charts').append(box);
  }
}
function makeBar() {
  const bar = document.getElementById('bar');
  for (const policy of policies) {
    const item = document.createElement('label');
    const box = document.createElement('input'), swatch = document.createElement('span');
    box.type = 'checkbox'; box.checked = true; swatch.className = 'swatch'; swatch.style.background = colour(policy);
    box.addEventListener('change', () => { box.checked ? state.hidden.delete(policy) : state.hidden.add(policy); drawAll(); });
    item.append(box, swatch, policy);
    bar.append(item);
  }
  if (seeds.length < 2) return;
  const item = document.createElement('label'), choice = document.createElement('select');
  seeds.forEach(seed => choice.append(new Option(seed, seed)));
  choice.addEventListener('change', () => { state.seed = seeds[choice.selectedIndex]; view = null; drawAll(); });
  item.append('seed', choice);
  bar.append(item);
}
function moveMap() {
  let from = null;
  map.addEventListener('pointerdown', event => { from = event; map.setPointerCapture(event.pointerId); });
  map.addEventListener('pointerup', () => { from = null; });
  map.addEventListener('pointermove', event => {
    if (!from) return;
    view.x -= (event.clientX - from.clientX) / view.scale;
    view.y += (event.clientY - from.clientY) / view.scale;
    from = event;
    drawMap();
  });
  map.addEventListener('wheel', event => {
    event.preventDefault();
    const dx = event.offsetX - map.clientWidth / 2, dy = event.offsetY - view.height / 2;
    const scale = Math.min(400, Math.max(.5, view.scale * Math.exp(-event.deltaY / 500)));
    view.x += dx / view.scale - dx / scale;
    view.y -= dy / view.scale - dy / scale;
    view.scale = scale;
    drawMap();
  }, { passive: false });
  map.addEventListener('dblclick', () => { fitView(); drawMap(); });
}
if (data.runs.length) {
  makeBar(); makeCharts(); moveMap(); drawAll();
  window.addEventListener('resize', () => { view = null; drawAll(); });
}
