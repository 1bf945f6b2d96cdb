// Cache of the page's colours and canvas widths. Drawing code reads them many times per frame, and
// the browser computes them slowly.

const styles = new Map();
export function style(name) {
  if (!styles.has(name))
    styles.set(name, getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim());
  return styles.get(name);
}

const SHADES = 64;
let loads = [];
const draws = [];  // functions that redraw canvases when colours change

const parse = (hex) => [1, 3, 5].map((i) => parseInt(
  hex.length === 4 ? hex[(i + 1) / 2] + hex[(i + 1) / 2] : hex.slice(i, i + 2), 16));

// The colour of a load from 0 to 1: the higher the load, the higher the contrast to the page.
export function loadColour(share) {
  const shade = Math.round(share * SHADES);
  if (!loads[shade]) {
    const from = parse(style("idle")), to = parse(style("busy"));
    loads[shade] =
      `rgb(${from.map((c, i) => Math.round(c + (to[i] - c) * shade / SHADES)).join(" ")})`;
  }
  return loads[shade];
}

matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
  styles.clear();
  loads = [];
  draws.forEach((draw) => draw());
});

// Calls `draw` when the canvas changes its size or the page its colours. Caches the canvas width
// for `widthOf`, since the browser recomputes it after every change of the page.
const widths = new WeakMap();
export function watchSize(canvas, draw) {
  draws.push(draw);
  new ResizeObserver(([{ contentRect }]) => {
    widths.set(canvas, contentRect.width);
    draw();
  }).observe(canvas);
}
export const widthOf = (canvas) => widths.get(canvas) ?? canvas.clientWidth;

// Sets the canvas resolution to that of the screen. Returns a drawing context in units of the page.
export function fit(canvas, height) {
  const ratio = window.devicePixelRatio || 1, width = widthOf(canvas);
  const w = Math.max(1, Math.round(width * ratio)), h = Math.max(1, Math.round(height * ratio));
  if (canvas.width !== w || canvas.height !== h) {
    canvas.width = w;
    canvas.height = h;
    canvas.style.height = height + "px";
  }
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  return { context, width, height };
}
