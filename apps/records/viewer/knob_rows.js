// SPDX-License-Identifier: BSD-3-Clause
// One row for each knob that the governor turned, on the time axis of the other plots; a sentence for those that it
// left alone; and where its fallback was in force. What draws the rows is in report.js, which follows.
const knobIn = (run, name) => (run.knobs || []).find(knob => knob.name === name);

/* A knob keeps its last value, and a fallback that never ended its step, until the flight ends. */
function closeKnobs(run) {
  const end = run.series.t[run.series.t.length - 1] || 0;
  for (const knob of run.knobs || []) {
    knob.t.push(Math.max(end, knob.t[knob.t.length - 1]));
    knob.v.push(knob.v[knob.v.length - 1]);
  }
  const steps = run.fallback || [];
  run.heldBack = steps.map(([from, step, why], i) => ({ from, to: i + 1 < steps.length ? steps[i + 1][0] : Math.max(end, from), step, why }))
    .filter(held => held.step !== 'none');
}

/* How a knob's values are written. */
const unitOf = knob => knob.labels || knob.unit === '1' ? '' : knob.unit === 'Hz' && knob.max >= 1e8 ? 'GHz' : knob.unit;
function knobNumber(knob, value) {
  if (knob.labels) return knob.labels[knob.legal.indexOf(value)] ?? String(value);
  const shown = unitOf(knob) === 'GHz' ? value * 1e-9 : value;
  return String(Math.abs(shown) >= 1000 ? Math.round(shown) : +shown.toPrecision(3));
}
const knobText = (knob, value) => (knobNumber(knob, value) + ' ' + unitOf(knob)).trim();
const unique = values => [...new Set(values)].sort((a, b) => a - b);
const spanText = (knob, values) => values.length > 1 ? knobNumber(knob, values[0]) + ' to ' + knobText(knob, values[values.length - 1]) : knobText(knob, values[0]);

const hasFew = knob => knob.legal && knob.legal.length <= 6;
/* From zero to the largest legal value, unless that would press what was used to the bottom. */
function knobAxis(knob, used) {
  const most = used[used.length - 1];
  if (knob.labels) return { low: knob.min - .25, high: knob.max + .25, marks: knob.legal };
  const high = 1.06 * (knob.max <= 2 * most ? knob.max : most) || 1, low = Math.min(0, knob.min);
  return { low, high, marks: hasFew(knob) ? knob.legal.filter(v => v <= high) : ticks(low, high, 3) };
}
function legalText(knob) {
  if (!knob.legal) return 'legal (shaded) ' + spanText(knob, [knob.min, knob.max]);
  return hasFew(knob) ? 'legal ' + knob.legal.map(v => knobNumber(knob, v)).join(', ') : `${knob.legal.length} legal values from ` + spanText(knob, [knob.min, knob.max]);
}
function knobHint(knob, used, runs) {
  const words = [unitOf(knob), knob.description, knob.name.startsWith('cpu.') ? 'as asked for' : '',
    knob.labels ? '' : 'used ' + spanText(knob, used),
    knob.labels ? '' : legalText(knob),
    runs.length === 1 ? knob.changes + (knob.changes === 1 ? ' change' : ' changes') : '',
    runs.length === 1 && knob.changes > knob.t.length ? 'drawn in outline' : ''];
  return words.filter(word => word).join('; ');
}

/* A knob that stands the same in all flights of the page needs no plot. */
function knobRows(runs, isShown) {
  const rows = [], alike = [];
  for (const name of new Set(runs.flatMap(run => (run.knobs || []).map(knob => knob.name)))) {
    const knobs = runs.map(run => knobIn(run, name)).filter(knob => knob), used = unique(knobs.flatMap(knob => knob.v));
    if (!isShown(name)) continue;
    if (used.length < 2) { alike.push(name + ' ' + knobText(knobs[0], used[0])); continue; }
    rows.push({ title: name, hint: knobHint(knobs[0], used, runs), lines: [{ knob: name, step: true }], axis: knobAxis(knobs[0], used),
                mark: v => knobNumber(knobs[0], v), legal: knobs[0].legal ? null : [knobs[0].min, knobs[0].max],
                showsFallback: true, height: 84, hidesTime: true });
  }
  if (rows.length) Object.assign(rows[rows.length - 1], { hidesTime: false, height: 106 });
  const where = runs.length > 1 ? 'all flights' : 'the flight';
  const constants = alike.length ? `Constant in ${where}: ${alike.join(', ')}.` : '';
  return { rows, note: [constants, fallbackSentence(runs)].filter(text => text).join(' ') };
}
function fallbackSentence(runs) {
  if (!runs.some(run => run.knobs)) return '';
  const counts = new Map();
  for (const { step } of runs.flatMap(run => run.heldBack)) counts.set(step, (counts.get(step) || 0) + 1);
  if (!counts.size) return 'The governor\'s fallback never acted.';
  const times = [...counts].map(([step, n]) => `${step} ${n === 1 ? 'once' : n + ' times'}`).join(', ');
  return `Red: the governor's fallback was in force (${times}).`;
}

function drawLegal(pen, legal, box, Y) {
  const top = Math.max(box.roof, Y(legal[1])), foot = Math.min(box.bottom, Y(legal[0]));
  pen.fillStyle = '#f1f5f8';
  pen.fillRect(box.left, top, box.right - box.left, foot - top);
}
/* A bar in the colour of the policy says whose fallback it was; the tint says for how long. */
function drawFallback(pen, run, box, X) {
  for (const { from, to } of run.heldBack) {
    const wide = Math.max(1.5, X(to) - X(from));
    pen.globalAlpha = .16; pen.fillStyle = '#b00020';
    pen.fillRect(X(from), box.roof, wide, box.bottom - box.roof);
    pen.globalAlpha = 1; pen.fillStyle = data.runs.length > 1 ? colour(run.policy) : '#b00020';
    pen.fillRect(X(from), box.roof - 4, Math.max(3, wide), 4);
  }
}
const fallbackAt = (run, time) => run.heldBack.find(held => held.from <= time && time < held.to);
