// Drawing of the network: processors and links coloured by load, messages in transit, and failed
// parts.
import { fit, loadColour, style, watchSize, widthOf } from "/colour.js";

// Lateral offset of each link from the straight line between its ends, so that parallel links are
// separate: 0 for a single link, -1/2 and 1/2 for two, and so on.
function asides(links) {
  const nth = [], count = new Map();
  for (const [a, b] of links) {
    const key = a < b ? `${a} ${b}` : `${b} ${a}`;
    nth.push([key, count.get(key) ?? 0, a < b ? 1 : -1]);
    count.set(key, nth.at(-1)[1] + 1);
  }
  return nth.map(([key, n, side]) => side * (n - (count.get(key) - 1) / 2));
}

export class Machine {
  constructor(canvas, outline, onChoose) {
    Object.assign(this, { canvas, outline, onChoose });
    const xs = outline.processors.map((p) => p.x), ys = outline.processors.map((p) => p.y);
    this.box = { left: Math.min(...xs), right: Math.max(...xs), low: Math.min(...ys),
      high: Math.max(...ys) };
    this.chosen = null;
    this.state = null;
    canvas.addEventListener("pointermove", (event) => this.pointed?.(this.find(event)));
    canvas.addEventListener("click", (event) => {
      const found = this.find(event);
      this.onChoose(found);
    });
    canvas.addEventListener("keydown", (event) => {
      const step = { ArrowRight: 1, ArrowLeft: -1, ArrowDown: 1, ArrowUp: -1 }[event.key];
      if (step === undefined) return;
      event.preventDefault();
      const what = /Up|Down/.test(event.key) ? "link" : "processor";
      const n = outline[what + "s"].length, now = this.chosen?.[what] ?? (step > 0 ? -1 : 0);
      if (n) this.onChoose({ [what]: (now + step + n) % n });
    });
    watchSize(canvas, () => this.draw());
  }

  layout() {
    const { left, right, low, high } = this.box, width = widthOf(this.canvas);
    const columns = right - left + 1.2, rows = high - low + 1.2;
    const unit = Math.min(width / columns, 420 / rows, 90);
    const height = Math.max(60, rows * unit);
    const x0 = (width - columns * unit) / 2;
    return { unit, height, place: (p) => [x0 + (p.x - left + 0.6) * unit,
      height - (p.y - low + 0.6) * unit] };
  }

  show(state) {
    this.state = state;
    this.draw();
  }

  // The two ends of a link on the canvas. Parallel links are drawn side by side.
  ends(link, { unit, place }) {
    const [a, b] = this.outline.links[link].map((id) => place(this.outline.processors[id]));
    this.aside ??= asides(this.outline.links);
    const length = Math.hypot(b[0] - a[0], b[1] - a[1]), off = 0.2 * unit * this.aside[link];
    const x = -off * (b[1] - a[1]) / length, y = off * (b[0] - a[0]) / length;
    return [[a[0] + x, a[1] + y], [b[0] + x, b[1] + y]];
  }

  draw() {
    const layout = this.layout(), { unit, height, place } = layout;
    const { context, width } = fit(this.canvas, height);
    context.clearRect(0, 0, width, height);
    const { processors, links } = this.outline, state = this.state;
    const cut = new Set(state?.cut);
    const stopped = new Set(state?.stopped);
    const cycle = state?.deadlock?.processors ?? [], waits = new Set(cycle);
    const thick = Math.max(1, unit / 18);
    context.setLineDash([]);
    links.forEach((_, i) => {
      const [[ax, ay], [bx, by]] = this.ends(i, layout);
      const mid = [(ax + bx) / 2, (ay + by) / 2];
      [[ax, ay, 2 * i], [bx, by, 2 * i + 1]].forEach(([x, y, direction]) => {
        const share = (state?.links[direction] ?? 0) / 1000;
        context.strokeStyle = cut.has(direction) ? style("warn") : loadColour(share);
        context.lineWidth = thick * (0.6 + 2.4 * share);
        context.setLineDash(cut.has(direction) ? [3, 4] : []);
        context.beginPath();
        context.moveTo(x, y);
        context.lineTo(...mid);
        context.stroke();
      });
      if (this.chosen?.link === i) {
        context.strokeStyle = style("accent");
        context.lineWidth = thick * 4;
        context.globalAlpha = 0.4;
        context.beginPath();
        context.moveTo(ax, ay);
        context.lineTo(bx, by);
        context.stroke();
        context.globalAlpha = 1;
      }
    });
    context.setLineDash([]);
    const radius = Math.min(22, unit * 0.3);
    this.drawMessages(context, layout, radius, Math.max(1.5, unit / 16));
    this.drawCycle(context, cycle, place, radius);
    context.textAlign = "center";
    context.textBaseline = "middle";
    processors.forEach((processor, i) => {
      const [x, y] = place(processor), share = (state?.cpus[i] ?? 0) / 1000;
      context.fillStyle = loadColour(share);
      context.beginPath();
      if (processor.role === "worker" || processor.role === "")
        context.arc(x, y, radius, 0, 7);
      else
        context.rect(x - radius, y - radius, 2 * radius, 2 * radius);
      context.fill();
      const isChosen = this.chosen?.processor === i;
      context.lineWidth = isChosen || waits.has(i) ? 3 : 0.75;
      context.strokeStyle = waits.has(i) || stopped.has(i) ? style("warn")
        : isChosen ? style("accent") : style("soft");
      context.stroke();
      if (stopped.has(i)) this.cross(context, x, y, radius);
      if (radius < 9) return;
      this.drawName(context, processor.name, x, y, radius, share);
      const ready = state?.queues[i] ?? 0;
      if (ready > 0) {
        context.fillStyle = style("ink");
        context.font = `${Math.round(radius * 0.55)}px system-ui, sans-serif`;
        context.fillText("+" + ready, x + radius * 1.25, y - radius * 0.9);
      }
    });
  }

  // Writes the name into the symbol, or below it if it would be too small to read.
  drawName(context, fullName, x, y, radius, share) {
    const name = fullName.match(/^(?:worker|p)(\d+)$/)?.[1] ?? fullName;
    const fitting = 3.4 * radius / name.length;  // letters are about half as wide as high
    const isInside = fitting >= 9;
    context.font = `${isInside ? Math.min(0.75 * radius, fitting) : 11}px system-ui, sans-serif`;
    context.fillStyle = isInside && share > 0.5 ? style("paper") : style("ink");
    if (isInside) return context.fillText(name, x, y);
    context.strokeStyle = style("paper");
    context.lineWidth = 3;
    context.strokeText(name, x, y + radius + 9);
    context.fillText(name, x, y + radius + 9);
  }

  // The line between two places: its ends, length, direction, and the gap at both ends.
  way([ax, ay], [bx, by], radius) {
    const length = Math.hypot(bx - ax, by - ay);
    return { ax, ay, bx, by, length, ux: (bx - ax) / length, uy: (by - ay) / length,
      margin: Math.min(radius, length / 3) };
  }

  // Draws each message in transit as a dot to the right of its link. The dot's position shows the
  // transferred share of the message.
  drawMessages(context, layout, radius, size) {
    const moving = this.state?.moving ?? [];
    context.fillStyle = style("high");
    for (let i = 0; i < moving.length; i += 2) {
      const ends = this.ends(moving[i] >> 1, layout);
      const [from, to] = moving[i] % 2 ? [ends[1], ends[0]] : ends;
      const { ax, ay, length, ux, uy, margin } = this.way(from, to, radius);
      const at = margin + (length - 2 * margin) * moving[i + 1] / 1000;
      context.beginPath();
      context.arc(ax + at * ux - 1.2 * size * uy, ay + at * uy + 1.2 * size * ux, size, 0, 7);
      context.fill();
    }
  }

  // Draws a deadlock's cycle of waits as arrows from processor to processor.
  drawCycle(context, cycle, place, radius) {
    context.strokeStyle = context.fillStyle = style("warn");
    context.lineWidth = 2.5;
    for (let i = 1; i < cycle.length; ++i) {
      if (cycle[i - 1] === cycle[i]) continue;  // both processes run on the same processor
      const { processors } = this.outline;
      const { ax, ay, bx, by, ux, uy, margin } =
        this.way(place(processors[cycle[i - 1]]), place(processors[cycle[i]]), radius + 2);
      const x = bx - ux * margin, y = by - uy * margin;
      context.beginPath();
      context.moveTo(ax + ux * margin, ay + uy * margin);
      context.lineTo(x - 6 * ux, y - 6 * uy);
      context.stroke();
      context.beginPath();
      context.moveTo(x, y);
      context.lineTo(x - 9 * ux - 5 * uy, y - 9 * uy + 5 * ux);
      context.lineTo(x - 9 * ux + 5 * uy, y - 9 * uy - 5 * ux);
      context.fill();
    }
  }

  cross(context, x, y, r) {
    context.beginPath();
    context.moveTo(x - r, y - r);
    context.lineTo(x + r, y + r);
    context.moveTo(x + r, y - r);
    context.lineTo(x - r, y + r);
    context.stroke();
  }

  // The processor or link under the pointer.
  find(event) {
    const layout = this.layout(), { unit, place } = layout;
    const box = this.canvas.getBoundingClientRect();
    const x = event.clientX - box.left, y = event.clientY - box.top;
    const { processors, links } = this.outline;
    const near = processors.findIndex((p) => {
      const [px, py] = place(p);
      return Math.hypot(px - x, py - y) < Math.max(6, Math.min(22, unit * 0.3) + 2);
    });
    if (near >= 0) return { processor: near };
    const link = links.findIndex((_, i) => {
      const [[ax, ay], [bx, by]] = this.ends(i, layout);
      const along = ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) /
        ((bx - ax) ** 2 + (by - ay) ** 2);
      return along > 0 && along < 1 &&
        Math.hypot(ax + along * (bx - ax) - x, ay + along * (by - ay) - y) < 5;
    });
    return link >= 0 ? { link } : null;
  }
}
