// Draws the waves of a report and zooms them: wheel, drag, two fingers, buttons, keys. No library, no network.
"use strict";

const ROW = 22, LABEL = 110, LEAST_TICKS = 4;

for (const section of document.querySelectorAll("section.waves")) show(section);

function show(section) {
  const data = JSON.parse(section.querySelector('script[type="application/json"]').textContent);
  const canvas = section.querySelector("canvas"), told = section.querySelector("output");
  const waves = data.waves.map(unfolded);
  const view = { first: 0, span: Math.max(data.end, LEAST_TICKS) };
  const draw = () => paint(canvas, waves, view, data, told);

  function move(first, span) {
    view.span = Math.min(Math.max(span, LEAST_TICKS), Math.max(data.end, LEAST_TICKS));
    view.first = Math.min(Math.max(first, 0), Math.max(data.end - view.span, 0));
    draw();
  }
  function zoom(factor, share) {
    move(view.first + view.span * share * (1 - factor), view.span * factor);
  }
  const actions = {
    in: () => zoom(0.5, 0.5), out: () => zoom(2, 0.5), all: () => move(0, data.end),
    left: () => move(view.first - view.span / 2, view.span), right: () => move(view.first + view.span / 2, view.span),
  };
  const keys = { "+": "in", "-": "out", "=": "all", "<": "left", ">": "right", ArrowLeft: "left", ArrowRight: "right" };
  section.addEventListener("click", event => { const act = actions[event.target.dataset.do]; if (act) act(); });
  canvas.addEventListener("keydown", event => {
    if (keys[event.key]) { event.preventDefault(); actions[keys[event.key]](); }
  });
  canvas.addEventListener("wheel", event => {
    event.preventDefault();
    zoom(event.deltaY < 0 ? 0.8 : 1.25, share(canvas, event));
  }, { passive: false });
  follow(canvas, view, move);
  new ResizeObserver(draw).observe(canvas.parentElement);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", draw);
}

function unfolded(wave) {
  const sum = numbers => { let at = 0; return numbers.map(each => at += each); };
  const ticks = sum(wave.ticks);
  const values = wave.values ? sum(wave.values) : ticks.map((_, row) => (wave.first + row) % 2);
  const bounds = values.reduce(([low, high], each) => [Math.min(low, each), Math.max(high, each)], [Infinity, -Infinity]);
  return { name: wave.name, ticks, values, low: bounds[0], high: bounds[1] };
}

function share(canvas, event) {
  const box = canvas.getBoundingClientRect();
  return Math.min(Math.max((event.clientX - box.left - LABEL) / (box.width - LABEL), 0), 1);
}

// One pointer drags, two pinch.
function follow(canvas, view, move) {
  const down = new Map();
  const spread = () => { const [a, b] = [...down.values()]; return Math.abs(a - b); };
  canvas.addEventListener("pointerdown", event => { canvas.setPointerCapture(event.pointerId); down.set(event.pointerId, event.clientX); });
  for (const over of ["pointerup", "pointercancel"])
    canvas.addEventListener(over, event => down.delete(event.pointerId));
  canvas.addEventListener("pointermove", event => {
    if (!down.has(event.pointerId)) return;
    const width = canvas.clientWidth - LABEL, before = down.size > 1 ? spread() : 0, from = down.get(event.pointerId);
    down.set(event.pointerId, event.clientX);
    if (down.size === 1) move(view.first - (event.clientX - from) * view.span / width, view.span);
    else if (spread() > 1) { const span = view.span * before / spread(); move(view.first + (view.span - span) / 2, span); }
  });
}

function paint(canvas, waves, view, data, told) {
  const width = canvas.parentElement.clientWidth, height = waves.length * ROW, dense = devicePixelRatio || 1;
  canvas.width = width * dense; canvas.height = height * dense; canvas.style.height = `${height}px`;
  const pen = canvas.getContext("2d"), style = getComputedStyle(document.documentElement);
  const colour = name => style.getPropertyValue(name).trim();
  pen.scale(dense, dense);
  pen.font = "11px system-ui, sans-serif";
  waves.forEach((wave, row) => {
    pen.fillStyle = colour("--faint");
    pen.fillText(wave.name, 2, row * ROW + 15, LABEL - 6);
    pen.strokeStyle = colour("--rotor");
    trace(pen, wave, view, row * ROW, width);
  });
  const from = view.first / data.hz, to = (view.first + view.span) / data.hz;
  told.textContent = `${from.toFixed(4)} .. ${to.toFixed(4)} s, ${Math.round(view.span)} ${data.words.ticks}`;
}

// The first row whose tick is after `tick`.
function after(ticks, tick) {
  let low = 0, high = ticks.length;
  while (low < high) { const middle = (low + high) >> 1; if (ticks[middle] <= tick) low = middle + 1; else high = middle; }
  return low;
}

// Column by column of the canvas, so that a pulse is seen however short it is.
function trace(pen, wave, view, top, width) {
  const across = width - LABEL, tall = ROW - 6, range = wave.high - wave.low || 1;
  const y = value => top + 3 + tall * (1 - (value - wave.low) / range);
  pen.beginPath();
  let row = Math.max(after(wave.ticks, view.first) - 1, 0), last = wave.values[row] ?? 0;
  pen.moveTo(LABEL, y(last));
  for (let x = 0; x < across; x++) {
    const end = view.first + view.span * (x + 1) / across;
    let low = last, high = last;
    while (row + 1 < wave.ticks.length && wave.ticks[row + 1] < end) {
      last = wave.values[++row]; low = Math.min(low, last); high = Math.max(high, last);
    }
    if (low !== high) { pen.lineTo(LABEL + x, y(low)); pen.lineTo(LABEL + x, y(high)); }
    pen.lineTo(LABEL + x + 1, y(last));
  }
  pen.stroke();
}
