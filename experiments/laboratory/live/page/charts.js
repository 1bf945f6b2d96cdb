// Charts over simulated time: a Gantt chart of the processors, and curves of progress.
import { fit, style, watchSize, widthOf } from "/colour.js";

const DOING = ["high", "low", "switching"];
const SAYS = ["high priority", "low priority", "switches"];
const LEFT = 78;  // width left of the Gantt chart, for names
const MOST_CHUNKS = 600;
const LONGEST_S = 1e4, SHORTEST_S = 1e-6;  // limits of the visible interval
const REDRAW_MS = 250;  // least time between redraws of the curves

const UNITS = [[1, "s"], [1e-3, "ms"], [1e-6, "µs"]];
// Formats a time in the unit of `largest`, so that all labels of an axis have the same unit.
export function tellTime(s, largest = s) {
  const [unit, name] = UNITS.find(([unit]) => largest >= unit) ?? UNITS.at(largest > 0 ? -1 : 1);
  return `${+(s / unit).toPrecision(7)} ${name}`;
}

export class TimeLine {
  constructor(canvas, processors, onChange) {
    Object.assign(this, { canvas, onChange,
      names: processors.slice(0, 64).map((p) => p.name) });
    // for each frame: the period whose spans it has, the first and last time of its spans, and the
    // spans
    this.chunks = [];
    this.open = [];  // spans that have not ended
    this.window = 0.01;
    this.to = null;  // time at the right edge; null: follow the present
    this.present = 0;
    this.listen();
    watchSize(canvas, () => this.draw());
  }

  // Adds the spans of a frame. They are a flat list of processor, activity, begin and end.
  add({ spans, open, t_s, spans_from_s, spans_cut }) {
    if (t_s < this.present) this.chunks = [];  // another machine begins
    this.open = open;
    this.present = t_s;
    let first = Infinity, last = spans_from_s;
    for (let i = 0; i < spans.length; i += 4) {
      first = Math.min(first, spans[i + 2]);
      last = Math.max(last, spans[i + 3]);
    }
    const to = spans_cut ? last : t_s, before = this.chunks.at(-1);
    if (!spans.length && before?.to === spans_from_s) before.to = to;
    else this.chunks.push({ from: spans_from_s, to, first, last, spans });
    if (this.chunks.length > MOST_CHUNKS) this.chunks.shift();
    this.draw();
  }

  get row() { return this.names.length > 24 ? 9 : 16; }
  get right() { return this.to ?? this.present; }
  get from() { return Math.max(0, this.right - this.window); }
  dateAt(event) {
    const box = this.canvas.getBoundingClientRect();
    const share = (event.clientX - box.left - LEFT) / (box.width - LEFT);
    return this.from + Math.min(1, Math.max(0, share)) * this.window;
  }

  // Scales the visible interval around the fixed time `at`.
  zoomBy(factor, at = this.right) {
    const window = Math.min(LONGEST_S, Math.max(SHORTEST_S, this.window * factor));
    const share = (at - this.from) / this.window;
    this.window = window;
    this.moveTo(at + (1 - share) * window);
  }

  moveTo(date) {
    const least = Math.min(this.window, this.present);
    this.to = date >= this.present ? null : Math.max(least, date);
    this.draw();
    this.onChange();
  }

  // Describes the span under the pointer.
  tell(event) {
    const box = this.canvas.getBoundingClientRect(), t = this.dateAt(event);
    const processor = Math.floor((event.clientY - box.top) / this.row);
    const name = this.names[processor];
    if (name === undefined || event.clientX < box.left + LEFT) return "";
    for (const { spans } of [{ spans: this.open }, ...this.chunks])
      for (let i = 0; i < spans.length; i += 4)
        if (spans[i] === processor && spans[i + 2] <= t && t <= spans[i + 3])
          return `${name}, ${tellTime(t)}: ${SAYS[spans[i + 1]]} for ` +
            tellTime(spans[i + 3] - spans[i + 2]);
    const isKnown = this.chunks.some(({ from, to }) => from <= t && t <= to);
    return `${name}, ${tellTime(t)}: ${isKnown ? "idle" : "not received"}`;
  }

  listen() {
    const { canvas } = this;
    let last = null;  // position of the pointer while the chart is dragged
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoomBy(event.deltaY < 0 ? 0.8 : 1.25, this.dateAt(event));
    }, { passive: false });
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      last = event.clientX;
    });
    canvas.addEventListener("pointermove", (event) => {
      this.pointed?.(this.tell(event));
      if (last === null) return;
      const shift = (event.clientX - last) / (widthOf(canvas) - LEFT) * this.window;
      last = event.clientX;
      this.moveTo(this.right - shift);
    });
    for (const end of ["pointerup", "pointercancel"])
      canvas.addEventListener(end, () => { last = null; });
    canvas.addEventListener("keydown", (event) => {
      const keys = { "+": () => this.zoomBy(0.5), "-": () => this.zoomBy(2),
        ArrowLeft: () => this.moveTo(this.right - this.window / 4),
        ArrowRight: () => this.moveTo(this.right + this.window / 4),
        End: () => this.moveTo(this.present) };
      if (!keys[event.key]) return;
      event.preventDefault();
      keys[event.key]();
    });
  }

  draw() {
    const { row, from, right: to } = this, height = row * this.names.length + 22;
    const { context, width } = fit(this.canvas, height);
    context.clearRect(0, 0, width, height);
    const x = (t) => LEFT + (t - from) / this.window * (width - LEFT);
    this.drawGaps(context, x, row * this.names.length);
    context.font = `${Math.max(9, row - 5)}px system-ui, sans-serif`;
    context.textBaseline = "middle";
    context.fillStyle = style("soft");
    const every = row < 12 ? 4 : 1;  // labels only some rows if names would overlap
    this.names.forEach((name, i) => {
      if (i % every === 0) context.fillText(name, 0, row * (i + 0.5), LEFT - 6);
    });
    const colours = DOING.map(style);
    // last drawn x, for each row and activity
    const drawn = new Float64Array(3 * this.names.length).fill(-1);
    const drawSpans = (spans) => {
      for (let i = 0; i < spans.length; i += 4) {
        if (spans[i + 3] < from || spans[i + 2] > to || spans[i] >= this.names.length) continue;
        const at = x(Math.max(spans[i + 2], from)), end = x(Math.min(spans[i + 3], to));
        const place = 3 * spans[i] + spans[i + 1];
        if (end < drawn[place]) continue;  // the span ends in a pixel that has this colour already
        context.fillStyle = colours[spans[i + 1]];
        const width = Math.max(0.5, end - at);
        drawn[place] = at + width;
        context.fillRect(at, row * spans[i] + 1, width, row - 3);
      }
    };
    for (const { first, last, spans } of this.chunks)
      if (last >= from && first <= to) drawSpans(spans);
    drawSpans(this.open);
    context.strokeStyle = style("rule");
    context.fillStyle = style("soft");
    context.font = "11px system-ui, sans-serif";
    for (let i = 0; i <= 4; ++i) {
      const t = from + this.window * i / 4;
      context.textAlign = i === 0 ? "left" : i === 4 ? "right" : "center";
      context.fillText(tellTime(t, to), x(t), height - 9);
      context.beginPath();
      context.moveTo(x(t), 0);
      context.lineTo(x(t), height - 18);
      context.stroke();
    }
    context.textAlign = "left";
  }

  // Shades the periods that this page has not received.
  drawGaps(context, x, height) {
    const { from, right: to } = this;
    context.fillStyle = style("unknown");
    context.fillRect(x(from), 0, x(Math.min(to, this.present)) - x(from), height);
    for (const chunk of this.chunks) {
      const left = Math.max(chunk.from, from), right = Math.min(chunk.to, to);
      if (left < right) context.clearRect(x(left), 0, x(right) - x(left), height);
    }
  }
}

const tellNumber = (value) => value === null ? "" : String(+value.toPrecision(6));

// One dygraphs chart for each curve: {name, help}. A chart is hidden until it has a value.
export class Curves {
  constructor(parent, things) {
    // The legend of dygraphs sets inline styles, which our content security policy forbids.
    const { Dygraph } = window;
    Dygraph.PLUGINS = Dygraph.PLUGINS.filter((plugin) => plugin !== Dygraph.Plugins.Legend);
    this.rows = [];
    this.curves = things.map(({ name, help }) => {
      const figure = document.createElement("figure"), caption = document.createElement("figcaption");
      const chart = document.createElement("div");
      figure.className = "curve";
      figure.title = help;
      figure.hidden = true;
      chart.className = "chart";
      figure.append(caption, chart);
      parent.append(figure);
      return { name, figure, caption, chart, points: [], graph: null, told: null };
    });
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
      for (const { graph } of this.curves) graph?.updateOptions(this.colours());
    });
  }

  // Adds samples of the history: rows of a number, a time and the value of each curve, null if
  // unknown. Keeps the same samples as the server: the first, the last and multiples of `stride`.
  add({ stride, samples }) {
    const { rows } = this;
    for (const row of samples) {
      while (rows.length && rows.at(-1)[1] >= row[1]) rows.pop();
      rows.push(row);
    }
    this.rows = rows.filter(([number], i) =>
      number % stride === 0 || i === 0 || i === rows.length - 1);
    this.timer ??= setTimeout(() => {
      this.timer = undefined;
      this.curves.forEach((curve, i) => {
        curve.points = this.rows.map((row) => [row[1], row[i + 2]]);
        this.draw(curve);
      });
    }, REDRAW_MS);
  }

  colours() {
    return { colors: [style("low")], axisLineColor: style("rule"), gridLineColor: style("rule") };
  }

  draw(curve) {
    if (curve.figure.hidden && curve.points.every(([, value]) => value === null)) return;
    curve.figure.hidden = false;
    if (!curve.told) this.say(curve);
    if (curve.graph) return curve.graph.updateOptions({ file: curve.points });
    curve.graph = new window.Dygraph(curve.chart, curve.points, { ...this.colours(),
      labels: ["simulated time", curve.name], includeZero: true, strokeWidth: 1.5,
      highlightCircleSize: 4, axisLabelFontSize: 11,
      axes: { x: { axisLabelWidth: 70, pixelsPerLabel: 90,
        axisLabelFormatter: (t, granularity, options, graph) =>
          tellTime(t, graph.xAxisRange()[1]) },
        y: { axisLabelWidth: 56, pixelsPerLabel: 30, axisLabelFormatter: tellNumber } },
      highlightCallback: (event, t, [{ yval }]) => {
        curve.told = true;
        this.say(curve, [t, yval]);
      },
      unhighlightCallback: () => {
        curve.told = null;
        this.say(curve);
      } });
  }

  // Shows a point in the caption, by default the last.
  say({ name, caption, points }, point = points.findLast(([, value]) => value !== null)) {
    const [t, value] = point;
    caption.textContent = `${name}: ${tellNumber(value)} at ${tellTime(t)}`;
  }
}
