// SPDX-License-Identifier: BSD-3-Clause
// Draws the flights of the page that it stands in, after top_view.js: no library, no network.
const data = JSON.parse(document.getElementById('data').textContent);
const palette = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9', '#7a5cad', '#444444'];
const policies = [...new Set(data.runs.map(run => run.policy))];
const seeds = [...new Set(data.runs.map(run => run.seed))];
const colour = policy => palette[policies.indexOf(policy) % palette.length];
const state = { seed: seeds[0], hidden: new Set(), time: null };
const shown = () => data.runs.filter(run => run.seed === state.seed && !state.hidden.has(run.policy));

// A mission without a map has no latency bound above zero: cell size and range of its map would mean nothing.
const hasMap = data.runs.some(run => (run.series.latency || []).some(v => v > 0));
const charts = [
  { title: 'Speed', unit: 'm/s', lines: [{ key: 'limit', dash: [4, 3], name: 'limit' }, { key: 'speed' }], digits: 2, showsFallback: true },
  { title: 'Latency bound', unit: 's', hint: 'the age that a map may reach before the next one comes, for which the speed limit allows', shown: hasMap, lines: [{ key: 'latency' }], digits: 2 },
  { title: 'Rotor power', unit: 'W', lines: [{ key: 'rotor' }], digits: 0 },
  { title: 'Computer power', unit: 'W', lines: [{ key: 'computer' }], digits: 1 },
  { title: 'Battery', unit: '%', lines: [{ key: 'battery' }], digits: 1, top: 100 },
  { title: 'Coverage', unit: '%', hint: 'measured in the true world; the vehicle does not know it', lines: [{ key: 'coverage' }], digits: 1, top: 100 },
].filter(chart => chart.shown !== false && data.runs.some(run => chart.lines.some(line => (run.series[line.key] || []).some(v => v !== null))));
for (const chart of charts) for (const run of data.runs) for (const line of chart.lines)
  run.series[line.key] = run.series[line.key] || [];
data.runs.forEach(closeKnobs);
const { rows, note } = knobRows(data.runs, name => hasMap || !name.startsWith('map.'));
const speedAt = charts.findIndex(chart => chart.title === 'Speed');
charts.splice(speedAt + 1, 0, ...rows);
if (charts.length) charts[Math.max(0, speedAt + rows.length)].note = note;

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
  let low = 0, high = Math.max(0, series.t.length - 1);
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
/* Times and values of a line: samples of a series, or the steps of a knob. */
function trackOf(run, line) {
  if (!line.knob) return { t: run.series.t, v: run.series[line.key] };
  return knobIn(run, line.knob) || { t: [], v: [] };
}
function axisOf(chart, runs) {
  if (chart.axis) return chart.axis;
  const top = Math.max(chart.top || 0, ...runs.flatMap(run => chart.lines.map(line => run.series[line.key].reduce((most, v) => Math.max(most, v), 0)))) || 1;
  const most = top * (chart.top ? 1 : 1.06), marks = ticks(0, most, 5);
  return { low: 0, high: Math.max(most, marks[marks.length - 1]), marks };
}
/* Lines at the marks, and their values where there is room for them. */
function drawValues(pen, chart, marks, box, Y) {
  let free = Infinity;
  pen.textBaseline = 'middle'; pen.textAlign = 'right';
  for (const v of marks) {
    pen.beginPath(); pen.moveTo(box.left, Math.round(Y(v)) + .5); pen.lineTo(box.right, Math.round(Y(v)) + .5); pen.stroke();
    if (Y(v) > free) continue;
    pen.fillText(chart.mark ? chart.mark(v) : String(v), box.left - 7, Y(v));
    free = Y(v) - 12;
  }
}
function drawTimes(pen, chart, end, box, X) {
  const times = ticks(0, end, Math.max(3, (box.right - box.left) / 110));
  pen.textAlign = 'center'; pen.textBaseline = 'top';
  times.forEach((t, i) => {
    pen.beginPath(); pen.moveTo(Math.round(X(t)) + .5, box.roof); pen.lineTo(Math.round(X(t)) + .5, box.bottom); pen.stroke();
    if (chart.hidesTime) return;
    const text = t + (i === times.length - 1 ? ' s' : ''), half = pen.measureText(text).width / 2;
    pen.fillText(text, Math.min(X(t), box.right + right - half), box.bottom + 6);
  });
}
function drawLine(pen, run, line, X, Y) {
  const { t, v } = trackOf(run, line);
  pen.strokeStyle = colour(run.policy); pen.lineWidth = line.dash ? 1 : 1.6; pen.setLineDash(line.dash || []);
  pen.beginPath();
  let open = false, before = 0;
  v.forEach((value, i) => {
    if (value === null) { open = false; return; }
    if (open && line.step) pen.lineTo(X(t[i]), Y(before));
    open ? pen.lineTo(X(t[i]), Y(value)) : pen.moveTo(X(t[i]), Y(value));
    open = true; before = value;
  });
  pen.stroke();
  if (!line.dash && failed(run) && t.length) cross(pen, X(t[t.length - 1]), Y(v[v.length - 1] || 0), colour(run.policy));
  pen.setLineDash([]);
}
function drawChart(chart) {
  const runs = shown(), [pen, width, height] = fit(chart.canvas, chart.height || 148), end = endTime(runs);
  const box = { left, right: width - right, roof: 8, bottom: height - (chart.hidesTime ? 4 : 26) };
  const axis = axisOf(chart, runs);
  const X = t => left + (width - left - right) * t / end;
  const Y = v => box.bottom - (box.bottom - box.roof) * (v - axis.low) / (axis.high - axis.low);
  chart.timeAt = x => (x - left) / (width - left - right) * end;
  if (chart.legal) drawLegal(pen, chart.legal, box, Y);
  pen.lineWidth = 1; pen.strokeStyle = '#e6ebef'; pen.fillStyle = '#6b7a88';
  drawValues(pen, chart, axis.marks, box, Y);
  drawTimes(pen, chart, end, box, X);
  if (chart.showsFallback) for (const run of runs) drawFallback(pen, run, box, X);
  for (const run of runs) for (const line of chart.lines) drawLine(pen, run, line, X, Y);
  if (state.time === null) return;
  pen.strokeStyle = '#9aa7b3'; pen.lineWidth = 1;
  pen.beginPath(); pen.moveTo(X(state.time), box.roof); pen.lineTo(X(state.time), box.bottom); pen.stroke();
}

function drawAll() { drawMap(); charts.forEach(drawChart); }

/* What the reader turns: seed, policies, time under the pointer, the map's view. */
const readout = document.getElementById('readout');
function showReadout(event, chart) {
  const lines = shown().map(run => {
    const gone = state.time > run.series.t[run.series.t.length - 1];
    const held = chart.showsFallback && fallbackAt(run, state.time);
    const values = chart.lines.slice().reverse().map(line => {
      const track = trackOf(run, line), v = track.v[indexAt(track, state.time)] ?? null;
      const text = v === null ? '-' : line.knob ? knobText(track, v) : v.toFixed(chart.digits) + ' ' + chart.unit;
      return (line.name ? line.name + ' ' : '') + text;
    }).concat(held ? [`fallback ${held.step}`] : []);
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
    const names = chart.lines.filter(l => l.name && data.runs.some(run => run.series[l.key].some(v => v !== null))).map(l => (l.dash ? 'dashed: ' : 'solid: ') + l.name);
    const hint = document.createElement('span'), title = document.createElement('h2'), canvas = document.createElement('canvas');
    hint.className = 'hint'; hint.textContent = [chart.unit, chart.hint, ...names].filter(text => text).join('; ');
    title.append(chart.title + ' ', hint);
    box.append(title, canvas);
    chart.canvas = canvas;
    chart.canvas.addEventListener('pointermove', event => {
      const time = chart.timeAt(event.offsetX);
      state.time = time >= 0 && time <= endTime(shown()) ? time : null;
      state.time === null ? readout.style.display = 'none' : showReadout(event, chart);
      drawAll();
    });
    chart.canvas.addEventListener('pointerleave', () => { state.time = null; readout.style.display = 'none'; drawAll(); });
    if (chart.note) {
      const text = document.createElement('p');
      text.className = 'note'; text.textContent = chart.note;
      box.append(text);
    }
    document.getElementById('charts').append(box);
  }
}
function makeLegend() {
  const words = ['grey: solid at flight height', 'pale: lower than that'];
  if (data.runs.some(run => run.map)) words.push('coloured squares: occupied in the map that was made');
  if (data.runs.some(run => run.footprint)) words.push('tinted: photographed', 'dashed: to be photographed');
  if (data.runs.some(run => run.people)) words.push('dotted: the path of the person');
  if (data.runs.some(run => run.sighting)) words.push('ring: the person was detected', 'red cross: a false detection');
  if (data.runs.some(failed)) words.push('coloured cross: where a flight ended without success');
  document.getElementById('legend').textContent =
    words.join(', ') + '; wheel zooms, dragging moves, a double click fits';
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
if (data.runs.length) {
  makeLegend(); makeBar(); makeCharts(); moveMap(); drawAll();
  window.addEventListener('resize', () => { view = null; drawAll(); });
}
