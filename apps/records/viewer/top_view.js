// SPDX-License-Identifier: BSD-3-Clause
// The world from above with what the flights did in it. What it draws is in report.js, which follows.
'use strict';
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
function rasterImage({ rows }, ink) {
  const columns = Math.max(1, ...rows.map(r => r.length ? r[r.length - 2] + r[r.length - 1] : 0));
  const image = document.createElement('canvas');
  image.width = columns; image.height = rows.length;
  const pen = image.getContext('2d');
  pen.fillStyle = ink;
  rows.forEach((runs, y) => { for (let i = 0; i < runs.length; i += 2) pen.fillRect(runs[i], rows.length - 1 - y, runs[i + 1], 1); });
  return image;
}
function drawRaster(pen, raster, ink, X, Y) {
  raster.image = raster.image || rasterImage(raster, ink);
  const cell = raster.cell_m * view.scale;
  pen.imageSmoothingEnabled = false;
  pen.drawImage(raster.image, X(raster.x_m), Y(raster.y_m) - raster.image.height * cell,
                raster.image.width * cell, raster.image.height * cell);
}
function drawSolid(pen, solids, ink, X, Y) {
  pen.fillStyle = ink;
  if (solids.raster) drawRaster(pen, solids.raster, ink, X, Y);
  for (const [x0, y0, x1, y1] of solids.boxes || [])
    pen.fillRect(X(x0), Y(y1), Math.max(1, (x1 - x0) * view.scale), Math.max(1, (y1 - y0) * view.scale));
  for (const [x, y, r] of solids.pillars) {
    pen.beginPath(); pen.arc(X(x), Y(y), Math.max(1, r * view.scale), 0, 2 * Math.PI); pen.fill();
  }
}
/* What the flight's map holds as occupied. */
function drawMade(pen, run, X, Y) {
  if (!run.map) return;
  pen.globalAlpha = .6;
  drawRaster(pen, run.map, colour(run.policy), X, Y);
  pen.globalAlpha = 1;
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
/* Where people truly were; until the time under the pointer, if any. */
function drawPeople(pen, run, X, Y) {
  const far = state.time === null ? run.series.t.length - 1 : indexAt(run.series, state.time);
  for (const { x, y } of run.people || []) {
    if (far < 0) continue;
    pen.strokeStyle = '#22303c'; pen.fillStyle = '#22303c'; pen.lineWidth = 1.4; pen.setLineDash([2, 3]);
    pen.beginPath();
    for (let i = 0; i <= far; ++i) i ? pen.lineTo(X(x[i]), Y(y[i])) : pen.moveTo(X(x[i]), Y(y[i]));
    pen.stroke(); pen.setLineDash([]);
    pen.beginPath(); pen.arc(X(x[far]), Y(y[far]), 3.5, 0, 2 * Math.PI); pen.fill();
    label(pen, X(x[far]), Y(y[far]) + 13, 'person', '#22303c');
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
  if (found) label(pen, X(found[0]), Y(found[1]) - 26, `first detected at ${found[6].toFixed(0)} s`, '#00694d');
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
  if (world.low) drawSolid(pen, world.low, '#dde3e9', X, Y);
  drawSolid(pen, world, '#97a3af', X, Y);
  for (const run of runs) drawMade(pen, run, X, Y);
  for (const run of runs) drawCovered(pen, run, X, Y);
  for (const run of runs) drawPath(pen, run, X, Y);
  if (runs.length) drawPeople(pen, runs[0], X, Y);
  for (const run of runs) drawSightings(pen, run, X, Y);
  drawPlace(pen, X(world.start[0]), Y(world.start[1]), 'start');
  if (world.goal && String(world.goal) !== String(world.start)) drawPlace(pen, X(world.goal[0]), Y(world.goal[1]), 'goal');
  runs.filter(failed).forEach(run => {
    const last = run.series.x.length - 1;
    if (last < 0) return;
    const x = X(run.series.x[last]), y = Y(run.series.y[last]);
    cross(pen, x, y, colour(run.policy));
    label(pen, x, y + 16, run.policy + ': ' + wordFor(run), colour(run.policy));
  });
  drawScale(pen, width, height);
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
