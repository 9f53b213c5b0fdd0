// SPDX-License-Identifier: BSD-3-Clause
// Draws the flights of the page that it stands in, after top_view.js: no library, no network.
const data = JSON.parse(document.getElementById('data').textContent);
const palette = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9', '#7a5cad', '#444444'];
const policies = [...new Set(data.runs.map(run => run.policy))];
const seeds = [...new Set(data.runs.map(run => run.seed))];
const colour = policy => palette[policies.indexOf(policy) % palette.length];
const state = { seed: seeds[0], hidden: new Set(), time: null };
const shown = () => data.runs.filter(run => run.seed === state.seed && !state.hidden.has(run.policy));

// A mission without a map has no latency bound above zero: the cell size of its map would mean nothing.
const hasMap = data.runs.some(run => (run.series.latency || []).some(v => v > 0));
const charts = [
  { title: 'Map resolution', unit: 'm', hint: 'size of the cells of the map', shown: hasMap, lines: [{ key: 'resolution', step: true }], digits: 2 },
  { title: 'Latency bound', unit: 's', hint: 'the age that a map may reach before the next one comes, for which the speed limit allows', shown: hasMap, lines: [{ key: 'latency' }], digits: 2 },
  { title: 'Speed', unit: 'm/s', lines: [{ key: 'limit', dash: [4, 3], name: 'limit' }, { key: 'speed' }], digits: 2 },
  { title: 'Rotor power', unit: 'W', lines: [{ key: 'rotor' }], digits: 0 },
  { title: 'Computer power', unit: 'W', lines: [{ key: 'computer' }], digits: 1 },
  { title: 'Battery', unit: '%', lines: [{ key: 'battery' }], digits: 1, top: 100 },
  { title: 'Coverage', unit: '%', hint: 'measured in the true world; the vehicle does not know it', lines: [{ key: 'coverage' }], digits: 1, top: 100 },
].filter(chart => chart.shown !== false && data.runs.some(run => chart.lines.some(line => (run.series[line.key] || []).some(v => v !== null))));
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
    const names = chart.lines.filter(l => l.name && data.runs.some(run => run.series[l.key].some(v => v !== null))).map(l => (l.dash ? 'dashed: ' : 'solid: ') + l.name);
    box.innerHTML = `<h2>${chart.title} <span class="hint">${chart.unit}${chart.hint ? '; ' + chart.hint : ''}${names.length ? '; ' + names.join(', ') : ''}</span></h2><canvas></canvas>`;
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
