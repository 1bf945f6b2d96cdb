// Colours of the page's style, for what is drawn on canvas.

let styles;
export function style(name) {
  styles ??= getComputedStyle(document.documentElement);
  return styles.getPropertyValue("--" + name).trim();
}

const parse = (hex) => [1, 3, 5].map((i) => parseInt(
  hex.length === 4 ? hex[(i + 1) / 2] + hex[(i + 1) / 2] : hex.slice(i, i + 2), 16));

// Of a share, 0 to 1: from idle to busy, ever further from the paper.
export function loadColour(share) {
  const from = parse(style("idle")), to = parse(style("busy"));
  return `rgb(${from.map((c, i) => Math.round(c + (to[i] - c) * share)).join(" ")})`;
}

matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { styles = null; });

// A canvas whose pixels are those of the screen; returns its context in units of the page.
export function fit(canvas, height) {
  const ratio = window.devicePixelRatio || 1, width = canvas.clientWidth;
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
