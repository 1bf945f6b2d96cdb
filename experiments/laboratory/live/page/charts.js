// Things over simulated time: the time line of processors, and curves of gauges.
import { fit, style } from "/colour.js";

const DOING = ["high", "low", "switching"];
const MOST_SPANS = 60000, MOST_POINTS = 2000;

export class TimeLine {
  constructor(canvas, processors) {
    Object.assign(this, { canvas, names: processors.slice(0, 64).map((p) => p.name) });
    this.spans = [];  // processor, doing, from, to
    this.window = 0.01;
    new ResizeObserver(() => this.draw()).observe(canvas);
  }

  add(state) {
    for (let i = 0; i < state.spans.length; i += 4) this.spans.push(state.spans.slice(i, i + 4));
    if (this.spans.length > MOST_SPANS) this.spans.splice(0, this.spans.length - MOST_SPANS);
    this.end = state.t_s;
    this.draw();
  }

  draw() {
    const row = this.names.length > 24 ? 9 : 16, height = row * this.names.length + 22;
    const { context, width } = fit(this.canvas, height);
    context.clearRect(0, 0, width, height);
    const left = 78, to = this.end ?? 0, from = Math.max(0, to - this.window);
    const x = (t) => left + (t - from) / this.window * (width - left);
    context.font = `${Math.max(9, row - 5)}px system-ui, sans-serif`;
    context.textBaseline = "middle";
    context.fillStyle = style("soft");
    const every = row < 12 ? 4 : 1;  // names would be in each other's way
    this.names.forEach((name, i) => {
      if (i % every === 0) context.fillText(name, 0, row * (i + 0.5), left - 6);
    });
    const colours = DOING.map(style);
    for (let i = this.spans.length - 1; i >= 0; --i) {
      const [processor, doing, begin, end] = this.spans[i];
      if (end < from || begin > to || processor >= this.names.length) continue;
      context.fillStyle = colours[doing];
      const at = x(Math.max(begin, from));
      context.fillRect(at, row * processor + 1, Math.max(0.5, x(Math.min(end, to)) - at), row - 3);
    }
    context.strokeStyle = style("rule");
    context.fillStyle = style("soft");
    context.font = "11px system-ui, sans-serif";
    for (let i = 0; i <= 4; ++i) {
      const t = from + this.window * i / 4;
      context.textAlign = i === 0 ? "left" : i === 4 ? "right" : "center";
      context.fillText(`${+(t * 1e3).toPrecision(7)} ms`, x(t), height - 9);
      context.beginPath();
      context.moveTo(x(t), 0);
      context.lineTo(x(t), height - 18);
      context.stroke();
    }
    context.textAlign = "left";
  }
}

// One small chart for each gauge.
export class Curves {
  constructor(parent, gauges) {
    this.curves = gauges.map(({ name, help }) => {
      const figure = document.createElement("figure"), canvas = document.createElement("canvas");
      const caption = document.createElement("figcaption");
      figure.className = "curve";
      figure.title = help;
      canvas.setAttribute("aria-label", `${name} over simulated time`);
      figure.append(caption, canvas);
      parent.append(figure);
      return { name, canvas, caption, points: [] };
    });
  }

  add(state) {
    this.curves.forEach((curve, i) => {
      const { points } = curve, point = [state.t_s, state.gauges[i]];
      if (points.length && points.at(-1)[0] === point[0]) points.pop();
      points.push(point);
      // Every second point goes when there are too many.
      if (points.length > MOST_POINTS) curve.points = points.filter((_, j) => j % 2 === 0);
      this.draw(curve);
    });
  }

  draw({ name, canvas, caption, points }) {
    const height = 70, { context, width } = fit(canvas, height);
    context.clearRect(0, 0, width, height);
    const last = points.at(-1);
    caption.textContent = `${name}: ${+last[1].toPrecision(8)}`;
    const most = Math.max(1e-12, ...points.map((p) => p[1]));
    const x = (t) => t / Math.max(last[0], 1e-12) * (width - 2) + 1;
    const y = (v) => height - 2 - v / most * (height - 8);
    context.strokeStyle = style("rule");
    context.strokeRect(0.5, 0.5, width - 1, height - 1);
    context.strokeStyle = style("low");
    context.lineWidth = 1.5;
    context.beginPath();
    points.forEach(([t, v], i) => context[i ? "lineTo" : "moveTo"](x(t), y(v)));
    context.stroke();
  }
}
