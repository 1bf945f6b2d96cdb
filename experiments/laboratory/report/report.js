// Interactive parts of a report: plots that show values and points, and tables that can be sorted
// and folded. Without this script the page shows static plots and complete tables.
"use strict";
(() => {
  const {plots, points} =
      JSON.parse(document.querySelector('script[type="application/json"]').textContent);

  // ---- Page elements ----

  function fill(element, attributes, children) {
    for (const [name, value] of Object.entries(attributes ?? {}))
      if (value !== undefined) element.setAttribute(name, value);
    element.append(...children);
    return element;
  }
  const make = (name, attributes, ...children) =>
      fill(document.createElement(name), attributes, children);
  const draw = (name, attributes, ...children) =>
      fill(document.createElementNS("http://www.w3.org/2000/svg", name), attributes, children);
  function makeButton(text, title, click) {
    const button = make("button", {type: "button", title}, text);
    button.addEventListener("click", click);
    return button;
  }

  const unitless = label => label.replace(/ \[[^\]]*\]$/, "");
  const tell = value => value === 0 || (Math.abs(value) >= 1e-4 && Math.abs(value) < 1e7)
      ? String(Number(value.toPrecision(4))) : value.toExponential(3);

  // ---- Details of points: loads and bottlenecks ----

  function makeDetails(number, close) {
    const {name, ended, why, loads} = points[number];
    const box = make("div", {class: "point", tabindex: -1, role: "region",
                             "aria-label": `point ${number + 1}`});
    const button = makeButton("×", "close (Escape)", close);
    button.setAttribute("aria-label", "close");
    box.append(button, make("p", {}, make("strong", {}, name || "The point"),
                            ended === "done" ? "" : ` (${ended})`));
    box.append(make("p", {class: "why"}, why || "How busy it was has not been measured."));
    const body = make("tbody");
    for (const [resource, busy, doing] of loads) {
      const bar = make("span", {class: "bar"});
      bar.style.width = `${100 * Math.min(1, busy)}%`;
      body.append(make("tr", {}, make("th", {scope: "row"}, resource),
                       make("td", {class: "bars"}, bar),
                       make("td", {class: "number"}, busy.toFixed(3)), make("td", {}, doing)));
    }
    if (loads.length > 0)
      box.append(make("div", {class: "wide"}, make("table", {}, make("thead", {}, make("tr", {},
          make("th", {scope: "col"}, "resource"), make("th", {scope: "col", colspan: 2},
          "busy"), make("th", {scope: "col"}, "with"))), body)));
    box.addEventListener("keydown", event => {
      if (event.key === "Escape") close();
    });
    return box;
  }

  // ---- Scales ----

  const isPowerOfTwo = value => Number.isInteger(Math.log2(value));

  // Maps values to pixels: the value `low` to `from`, `high` to `to`.
  function makeScale(log, low, high, from, to) {
    const way = log ? Math.log : value => value;
    const a = way(low), b = way(high);
    const scale = value => from + (way(value) - a) / (b - a) * (to - from);
    return Object.assign(scale, {log, low, high, from, to});
  }

  function chooseStep(length, most) {
    const least = length / most, power = 10 ** Math.floor(Math.log10(least));
    return [1, 2, 5, 10].map(factor => factor * power).find(step => step >= least * 0.999);
  }

  function makeLinearTicks({low, high}, most) {
    const ticks = [], step = chooseStep(high - low, most);
    for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i)
      ticks.push(Number((i * step).toPrecision(12)));
    return ticks;
  }

  function makeTicks(scale, most, base) {
    const {log, low, high} = scale;
    if (!log) return makeLinearTicks(scale, most);
    const ticks = [];
    const decades = Math.log10(high / low);
    const factors = base === 2 ? [1] : decades > most ? [1] : decades > 2.5 ? [1, 3] : [1, 2, 5];
    for (let i = Math.floor(Math.log(low) / Math.log(base)); base ** i <= high; ++i)
      for (const factor of factors) {
        const tick = factor * base ** i;
        if (tick >= low && tick <= high) ticks.push(Number(tick.toPrecision(12)));
      }
    // the range is less than a decade, so decades make too few ticks
    if (ticks.length < 2) return makeLinearTicks(scale, most);
    const every = Math.ceil(ticks.length / most);
    return ticks.filter((_, i) => i % every === 0);
  }

  // ---- Styles of curves ----

  const polygon = (corners, turn) => {
    let path = "";
    for (let i = 0; i < corners; ++i) {
      const angle = 2 * Math.PI * i / corners + turn;
      const x = 5 * Math.sin(angle), y = -5 * Math.cos(angle);
      path += `${i ? "L" : "M"}${x.toFixed(2)},${y.toFixed(2)}`;
    }
    return path + "Z";
  };
  // Symbols of Look: disc, square, triangle, diamond, triangle down, pentagon, cross, plus, star
  const SYMBOLS = [
    "M-4,0A4,4 0 1 1 4,0A4,4 0 1 1 -4,0Z", "M-4,-4H4V4H-4Z", polygon(3, 0), polygon(4, 0),
    polygon(3, Math.PI), polygon(5, 0), "M-4,-4L4,4M-4,4L4,-4", "M-5,0H5M0,-5V5",
    "M-4,-4L4,4M-4,4L4,-4M-5,0H5M0,-5V5",
  ];
  const STROKES = {curve: 2, law: 1, reference: 0, mark: 0};

  function drawSymbol(s, x, y, ring = s.kind === "mark" ? 9 : 0) {
    const at = {transform: `translate(${x.toFixed(2)},${y.toFixed(2)})`};
    if (ring > 0)
      return draw("circle", {...at, r: ring, fill: "none", stroke: "#000", "stroke-width": 1.5});
    const isOpen = s.kind === "reference";
    return draw("path", {...at, d: SYMBOLS[s.symbol], stroke: s.colour,
                         "stroke-width": isOpen || s.symbol > 5 ? 2 : 0.5,
                         fill: isOpen ? "none" : s.colour});
  }

  function drawSwatch(s) {
    const swatch = draw("svg", {viewBox: "0 0 34 14", width: 34, height: 14, "aria-hidden": true});
    if (STROKES[s.kind])
      swatch.append(draw("path", {d: "M1,7H33", stroke: s.colour, "stroke-width": STROKES[s.kind],
                                  "stroke-dasharray": s.dashes}));
    if (s.kind !== "law") swatch.append(drawSymbol(s, 17, 7, s.kind === "mark" ? 5 : 0));
    return swatch;
  }

  const IDEAL = {name: "ideal", kind: "law", colour: "#707070", dashes: "9,5", points: []};
  const LAWS = {
    "Amdahl's law": {dashes: "7,3,2,3", at: (serial, n) => 1 / (serial + (1 - serial) / n)},
    "Gustafson's law": {dashes: "2,3", at: (serial, n) => n + (1 - n) * serial},
  };

  // ---- A plot ----

  const TALL = 300, LOWER = 110, BELOW = 46, TOP = 12, RIGHT = 16, FONT = 13;

  class Plot {
    constructor(figure, data, number) {
      Object.assign(this, {figure, data, number});
      this.log = {x: data.x.log, y: data.y.log};
      this.hidden = new Set();  // hidden entries of the legend
      this.laws = new Set();  // names of the visible laws
      this.lawsAreChosen = false;  // true once the user has selected laws
      this.at = null;  // the selected point: series s, index i
      this.curves = data.series.filter(s => s.kind === "curve");
      const told = data.series.filter(s => s.kind === "curve" || s.kind === "reference");
      this.marks = [...new Set(data.series.filter(s => s.kind !== "law")
                                   .flatMap(s => s.points.map(p => p[0])))].sort((a, b) => a - b);
      this.doubles = this.marks.every(isPowerOfTwo);
      this.told = told;
      this.build();
      this.followLaws();
      this.update();
      new ResizeObserver(() => this.redraw()).observe(this.stage);
    }

    // ---- Visibility ----

    // The legend entry that shows or hides a series. Hiding a curve also hides its series.
    entryOf(s) { return s.name ? s : this.data.series.find(t => t.name && t.kind === s.kind) ?? s; }
    isShown(s) { return !this.hidden.has(this.entryOf(s)) && !this.hidden.has(this.curves[s.of]); }
    canBeDrawn([x, y]) { return (!this.log.x || x > 0) && (!this.log.y || y > 0); }
    bandOf(s) { return (s.band ?? []).filter(p => this.canBeDrawn(p)); }
    pointsOf(s) { return s.points.filter(p => this.canBeDrawn(p)); }
    canBeLog(axis) {
      return this.data.series.some(s => s.points.length > 0) &&
          this.data.series.every(s => s.points.every(p => p[axis === "x" ? 0 : 1] > 0));
    }

    // Shows the laws of speed-up by default if both axes are linear, where their shapes are familiar.
    followLaws() {
      if (this.lawsAreChosen || !this.data.laws) return;
      const are = !this.log.x && !this.log.y && this.curves.length <= 3;
      this.laws = new Set(are ? this.data.laws.map(({law}) => law) : []);
    }

    extent(axis, series) {
      let low = Infinity, high = -Infinity;
      for (const s of series)
        for (const p of this.pointsOf(s)) {
          low = Math.min(low, p[axis]);
          high = Math.max(high, p[axis]);
        }
      if (axis === 1)
        for (const [, from, to] of series.flatMap(s => this.bandOf(s))) {
          low = Math.min(low, from);
          high = Math.max(high, to);
        }
      return low <= high ? [low, high] : this.log[axis ? "y" : "x"] ? [1, 10] : [0, 1];
    }

    xScale(left, right) {
      const [low, high] = this.extent(0, this.data.series);
      const ratio = high > low ? (high / low) ** 0.04 : 1.5;
      const margin = high > low ? 0.04 * (high - low) : 0.5;
      return this.log.x ? makeScale(true, low / ratio, high * ratio, left, right)
                        : makeScale(false, low - margin, high + margin, left, right);
    }

    // Fits the scale to the visible series, so that small ones can be examined alone.
    yScale(bottom, top, xHigh) {
      const {min, max} = this.data.y;
      let [low, high] = this.extent(1, this.data.series.filter(s => this.isShown(s)));
      const showsIdeal = this.data.ideal && !this.hidden.has(IDEAL);
      if (this.log.y) {
        const margin = Math.max(1.1, (high / low) ** 0.06);
        const end = showsIdeal ? Math.max(high * margin, Math.min(xHigh, 2 * high)) : high * margin;
        return makeScale(true, low / margin, end, bottom, top);
      }
      if (this.data.y.log && low > 0) low = 0;  // begins at 0, as linear plots do
      if (min !== undefined) low = Math.min(min, low);
      if (showsIdeal) high = xHigh > 2.5 * high ? 1.5 * high : Math.max(high, xHigh);
      else if (max !== undefined) high = Math.max(high, max);
      const margin = 0.05 * (high - low || Math.abs(high) || 1);
      return makeScale(false, low === 0 ? 0 : low - margin, high + margin, bottom, top);
    }

    // ---- Elements of a plot ----

    build() {
      const {data, figure} = this;
      const still = figure.querySelector("svg");
      this.caption = still.getAttribute("aria-label");
      still.classList.add("still");
      this.svg = draw("svg", {class: "live", tabindex: 0, role: "application",
                              "aria-label": `${this.caption}. Arrow keys go from point to point, ` +
                                  "Enter tells how busy the machine was."});
      this.tip = make("div", {class: "tip", hidden: ""});
      this.said = make("div", {class: "said", "aria-live": "polite"});
      this.stage = make("div", {class: "stage"}, this.svg, this.tip);
      this.tools = make("div", {class: "tools", role: "toolbar", "aria-label": "axes and laws"});
      this.key = make("div", {class: "legend", role: "group", "aria-label": "curves"});
      this.details = make("div", {});
      still.after(make("p", {class: "title"}, data.title), this.tools, this.stage, this.key,
                  this.said, this.details);
      this.buildTools();
      this.buildKey();
      this.svg.addEventListener("pointermove", event => this.follow(event));
      this.svg.addEventListener("pointerdown", event => this.follow(event));
      this.svg.addEventListener("pointerleave", () => this.leave());
      this.svg.addEventListener("blur", () => this.leave());
      this.svg.addEventListener("click", event => {
        this.follow(event);  // on touch screens, pointerleave precedes click
        this.open();
      });
      this.svg.addEventListener("keydown", event => this.press(event));
    }

    buildTools() {
      this.pressed = [];  // buttons, each with a function that tells whether it is pressed
      const add = (text, title, is, click) => {
        const button = makeButton(text, title, () => {
          click();
          this.update();
        });
        this.tools.append(button);
        this.pressed.push([button, is]);
        return button;
      };
      for (const axis of ["x", "y"]) {
        const name = unitless(this.data[axis].label);
        const button = add(`log ${axis}`, `${name}: logarithmic or linear`, () => this.log[axis],
                           () => {
                             this.log[axis] = !this.log[axis];
                             this.followLaws();
                           });
        button.disabled = !this.log[axis] && !this.canBeLog(axis);
      }
      for (const law of new Set((this.data.laws ?? []).map(({law}) => law)))
        add(law, `${law}, fitted to each curve`, () => this.laws.has(law), () => {
          this.lawsAreChosen = true;
          if (!this.laws.delete(law)) this.laws.add(law);
        });
    }

    buildKey() {
      const named = this.data.series.filter(s => s.name);
      const entries = this.data.ideal ? [IDEAL, ...named] : named;
      if (entries.length === 0) this.key.hidden = true;
      this.serials = [];  // labels of visible laws beside the curves
      for (const s of entries) {
        const text = make("span", {}, s.name);
        const serial = make("span", {class: "serial"});
        const button = makeButton("", "on and off; with Shift: this one alone", event => {
          if (!event.shiftKey) {
            if (!this.hidden.delete(s)) this.hidden.add(s);
          } else {
            const isAlone = entries.every(t => (t === s) !== this.hidden.has(t));
            this.hidden = new Set(isAlone ? [] : entries.filter(t => t !== s));
          }
          this.update();
        });
        button.append(drawSwatch(s), text, serial);
        this.key.append(button);
        this.pressed.push([button, () => !this.hidden.has(s)]);
        if (s.kind === "curve") this.serials.push([serial, s.of]);
      }
    }

    update() {
      for (const [button, is] of this.pressed) button.setAttribute("aria-pressed", is());
      for (const [text, of] of this.serials)
        text.textContent = (this.data.laws ?? [])
            .filter(l => l.of === of && this.laws.has(l.law))
            .map(l => ` · ${l.law.split("'")[0]} s = ${l.serial.toPrecision(3)}`).join("");
      this.at = null;
      this.redraw();
    }

    // ---- Drawing ----

    redraw() {
      const width = this.stage.clientWidth;
      if (width === 0) return;
      const lower = this.data.difference ? LOWER + 14 : 0;
      const height = TOP + TALL + lower + BELOW, bottom = TOP + TALL;
      this.svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
      this.svg.style.height = `${height}px`;
      this.svg.replaceChildren(draw("rect", {width, height, fill: "#fff"}));
      const y = this.yScale(bottom, TOP, this.extent(0, this.data.series)[1]);
      const yBase = y.log && this.data.ideal && this.doubles ? 2 : 10;
      const yTicks = makeTicks(y, 8, yBase);
      let lowerScale, lowerTicks = [];
      if (lower) {
        lowerScale = this.lowerScale(bottom + lower, bottom + 14);
        lowerTicks = makeTicks(lowerScale, 5, 10);
      }
      const widest = Math.max(...[...yTicks, ...lowerTicks].map(tick => tell(tick).length));
      const left = 34 + widest * FONT * 0.6;
      const x = this.xScale(left, width - RIGHT);
      const most = Math.max(3, Math.floor((width - left) / 55));
      const xTicks = x.log && this.marks.length <= most ? this.marks.filter(mark => mark > 0)
                                                      : makeTicks(x, most, this.doubles ? 2 : 10);
      this.x = x;
      this.y = y;
      this.drawPanel(x, y, xTicks, yTicks, this.data.y.label, !lower);
      this.drawCurves(x, y, this.data.series);
      if (lower) {
        this.drawPanel(x, lowerScale, xTicks, lowerTicks, this.data.difference.label, true);
        this.drawCurves(x, lowerScale, this.data.difference.series);
      }
      this.text(this.data.x.label, (x.from + x.to) / 2, height - 8, "middle");
      this.pointer = this.svg.appendChild(draw("g", {"pointer-events": "none"}));
      this.show();
    }

    text(text, x, y, anchor, more) {
      this.svg.append(draw("text", {x, y, "text-anchor": anchor, ...more}, text));
    }

    drawPanel(x, y, xTicks, yTicks, label, hasNumbers) {
      const line = (attributes, from, to) => this.svg.append(draw("path", {
        d: `M${from.map(v => v.toFixed(1))}L${to.map(v => v.toFixed(1))}`, fill: "none",
        ...attributes}));
      const grid = {stroke: "#d8d8d8", "stroke-width": 0.8};
      for (const tick of xTicks) {
        line(grid, [x(tick), y.from], [x(tick), y.to]);
        if (hasNumbers) this.text(tell(tick), x(tick), y.from + 17, "middle");
      }
      for (const tick of yTicks) {
        line(grid, [x.from, y(tick)], [x.to, y(tick)]);
        this.text(tell(tick), x.from - 7, y(tick) + 4, "end");
      }
      if (y.low < 0 && y.high > 0 && !y.log)
        line({stroke: "#707070"}, [x.from, y(0)], [x.to, y(0)]);
      line({stroke: "#404040", "stroke-width": 1.2}, [x.from, y.to], [x.from, y.from]);
      line({stroke: "#404040", "stroke-width": 1.2}, [x.from, y.from], [x.to, y.from]);
      this.text(label, 0, 0, "middle",
                {transform: `translate(14,${(y.from + y.to) / 2}) rotate(-90)`});
    }

    lowerScale(bottom, top) {
      const all = this.data.difference.series.flatMap(s => s.points.map(p => p[1]));
      const low = Math.min(0, ...all), high = Math.max(0, ...all);
      const margin = Math.max(0.1 * (high - low), 0.5);
      return makeScale(false, low - margin, high + margin, bottom, top);
    }

    // Draws the curves, clipped to the panel.
    drawCurves(x, y, series) {
      const id = `clip${this.number}${series === this.data.series ? "" : "l"}`;
      this.svg.append(draw("clipPath", {id}, draw("rect", {
        x: x.from - 6, y: y.to - 6, width: x.to - x.from + 12, height: y.from - y.to + 12})));
      const group = this.svg.appendChild(draw("g", {"clip-path": `url(#${id})`}));
      const line = (points, attributes) => group.append(draw("path", {
        d: points.map((p, i) => `${i ? "L" : "M"}${x(p[0]).toFixed(2)},${y(p[1]).toFixed(2)}`)
               .join(""), fill: "none", ...attributes}));
      if (series === this.data.series) this.drawLaws(x, y, line);
      for (const s of series) {
        const band = this.isShown(s) ? this.bandOf(s) : [];
        if (band.length > 1)
          line([...band.map(([at, low]) => [at, low]),
                ...band.map(([at, , high]) => [at, high]).reverse()],
               {fill: s.colour, "fill-opacity": 0.18});
      }
      for (const s of series) {
        if (!this.isShown(s)) continue;
        const points = this.pointsOf(s);
        if (STROKES[s.kind])
          line(points, {stroke: s.colour, "stroke-width": STROKES[s.kind],
                        "stroke-dasharray": s.kind === "curve" ? s.dashes : ""});
        if (s.kind !== "law")
          for (const p of points) group.append(drawSymbol(s, x(p[0]), y(p[1])));
      }
    }

    drawLaws(x, y, line) {
      const xs = [];
      for (let i = 0; i <= 200; ++i)
        xs.push(x.log ? x.low * (x.high / x.low) ** (i / 200) : x.low + (x.high - x.low) * i / 200);
      const curve = (at, attributes) =>
          line(xs.map(n => [n, at(n)]).filter(p => this.canBeDrawn(p) && p[0] > 0), attributes);
      if (this.data.ideal && !this.hidden.has(IDEAL))
        curve(n => n,
              {stroke: IDEAL.colour, "stroke-width": 1.5, "stroke-dasharray": IDEAL.dashes});
      for (const {law, of, serial} of this.data.laws ?? [])
        if (this.laws.has(law) && !this.hidden.has(this.curves[of]))
          curve(n => LAWS[law].at(serial, n), {stroke: this.curves[of].colour, "stroke-width": 1,
                                               "stroke-dasharray": LAWS[law].dashes});
    }

    // ---- The selected point ----

    shownPoints() {
      return this.told.filter(s => this.isShown(s)).flatMap(
          s => s.points.map((p, i) => ({s, i, p})).filter(({p}) => this.canBeDrawn(p)));
    }

    // Selects the point with the nearest x, and among these the nearest y.
    follow(event) {
      const box = this.svg.getBoundingClientRect();
      const px = event.clientX - box.left, py = event.clientY - box.top;
      let best = null, least = Infinity;
      for (const at of this.shownPoints()) {
        const distance =
            1e4 * Math.abs(this.x(at.p[0]) - px) + Math.abs(this.y(at.p[1]) - py);
        if (distance < least) [best, least] = [at, distance];
      }
      this.at = best;
      this.show();
    }

    leave() {
      this.at = null;
      this.show();
    }

    show() {
      this.pointer.replaceChildren();
      this.tip.hidden = !this.at;
      if (!this.at) return;
      const {s, p} = this.at;
      const px = this.x(p[0]), py = this.y(p[1]);
      this.pointer.append(
          draw("path", {d: `M${px},${this.y.to}V${this.y.from}`, stroke: "#707070"}),
          drawSymbol(s, px, py, 9));
      const label = unitless(this.data.y.label);
      this.tip.replaceChildren(make("div", {}, `${this.data.x.label} ${tell(p[0])}`));
      const beside = this.shownPoints().filter(at => at.p[0] === p[0])
                         .sort((a, b) => b.p[1] - a.p[1]);
      for (const at of beside) {
        const isThis = at.s === s && at.i === this.at.i;
        this.tip.append(make("div", {class: isThis ? "this" : undefined}, drawSwatch(at.s),
                             `${at.s.name || label} `, make("b", {}, tell(at.p[1]))));
      }
      if (points[p[2]]?.loads.length) this.tip.append(make("div", {class: "hint"}, "click: why"));
      const room = this.stage.clientWidth - this.tip.offsetWidth;
      const left = px + 14 <= room ? px + 14 : px - 14 - this.tip.offsetWidth;
      this.tip.style.left = `${Math.max(0, Math.min(room, left))}px`;
      this.tip.style.top = `${Math.max(0, Math.min(py, TOP + TALL - this.tip.offsetHeight))}px`;
    }

    say() {
      const {s, p} = this.at;
      this.said.textContent = `${s.name ? s.name + ", " : ""}${this.data.x.label} ${tell(p[0])}: ` +
          `${this.data.y.label} ${tell(p[1])}`;
    }

    press(event) {
      const all = this.shownPoints();
      if (event.key === "Escape") {
        this.leave();
        this.details.replaceChildren();
      }
      if (event.key === "Enter" || event.key === " ") this.open(true);
      const steps = {ArrowRight: [0, 1], ArrowLeft: [0, -1], ArrowUp: [1, 1], ArrowDown: [1, -1]};
      const isStep = event.key in steps;
      if (isStep || event.key === "Enter" || event.key === " ") event.preventDefault();
      if (!isStep || all.length === 0) return;
      const [axis, way] = steps[event.key];
      const now = this.at ?? all[0];
      const near = all.filter(at => axis === 0 ? at.s === now.s : at.p[0] === now.p[0])
                       .sort((a, b) => a.p[axis] - b.p[axis]);
      const index = near.findIndex(at => at.s === now.s && at.i === now.i);
      this.at = this.at ? near[Math.max(0, Math.min(near.length - 1, index + way))] : now;
      this.show();
      this.say();
    }

    open(goes) {
      const point = this.at?.p[2];
      if (points[point] === undefined) return;
      const box = makeDetails(point, () => {
        this.details.replaceChildren();
        this.svg.focus({preventScroll: true});
      });
      this.details.replaceChildren(box);
      if (goes) box.focus({preventScroll: true});
    }
  }

  // ---- Tables ----

  const FEW = 12;  // number of rows shown of a folded table

  function makeRows(table) {
    const body = table.tBodies[0], rows = [...body.rows];
    let isFolded = rows.length > 2 * FEW, order = rows;

    function place() {
      for (const row of body.querySelectorAll("tr.told")) row.remove();
      for (const button of body.querySelectorAll("[aria-expanded]"))
        button.setAttribute("aria-expanded", false);
      table.classList.toggle("sorted", order !== rows);
      order.forEach((row, i) => row.classList.toggle("folded", isFolded && i >= FEW));
      body.append(...order);
    }

    const valueOf = (row, column) => {
      const text = row.cells[column].textContent.trim().replace(/^▸/, "");
      const number = text === "" ? NaN : Number(text);
      return {text, number};
    };
    // Compares two cells for sorting. Empty cells come last.
    function compare(a, b, way) {
      if (!a.text || !b.text) return !a.text - !b.text;
      return way * (Number.isNaN(a.number) || Number.isNaN(b.number)
                        ? a.text.localeCompare(b.text, "en", {numeric: true})
                        : a.number - b.number);
    }

    function sort(heading, column) {
      const was = heading.getAttribute("aria-sort");
      for (const other of table.tHead.rows[0].cells) other.removeAttribute("aria-sort");
      order = rows;
      if (was !== "descending") {
        const way = was === "ascending" ? -1 : 1;
        heading.setAttribute("aria-sort", way === 1 ? "ascending" : "descending");
        order = rows.map(row => ({row, value: valueOf(row, column)}))
                    .sort((a, b) => compare(a.value, b.value, way)).map(({row}) => row);
      }
      place();
    }

    if (rows.length > 1)
      [...table.tHead.rows[0].cells].forEach((heading, column) => {
        const button = makeButton(heading.textContent, "sort: up, down, as it was",
                                  () => sort(heading, column));
        heading.replaceChildren(button);
      });
    if (isFolded) {
      const button = makeButton("", undefined, () => {
        isFolded = !isFolded;
        name();
        place();
      });
      const name = () => {
        button.textContent = isFolded ? `All ${rows.length} rows` : `The first ${FEW} rows`;
        button.setAttribute("aria-expanded", !isFolded);
      };
      name();
      table.closest(".wide").after(make("p", {class: "fold"}, button));
    }
    for (const row of rows) addDetails(row);
    place();
  }

  // Makes a click on a row show or hide the loads of its point.
  function addDetails(row) {
    const number = Number(row.dataset.point);
    if (row.dataset.point === undefined || !points[number].loads.length) return;
    const toggle = () => {
      const next = row.nextElementSibling;
      const isOpen = next?.classList.contains("told") ?? false;
      button.setAttribute("aria-expanded", !isOpen);
      if (isOpen) {
        next.remove();
        return button.focus({preventScroll: true});
      }
      row.after(make("tr", {class: "told"},
                     make("td", {colspan: row.cells.length}, makeDetails(number, toggle))));
    };
    const button = makeButton("▸", "how busy it was, and why it is not faster", event => {
      event.stopPropagation();
      toggle();
    });
    button.setAttribute("aria-expanded", false);
    button.setAttribute("aria-label", "loads of this point");
    row.cells[0].prepend(button);
    row.classList.add("opens");
    row.addEventListener("click", () => {
      if (getSelection().isCollapsed) toggle();
    });
  }

  document.documentElement.classList.add("is-interactive");
  for (const table of document.querySelectorAll("main table")) makeRows(table);
  document.querySelectorAll("figure.plot").forEach((figure, i) => {
    if (plots[i]) new Plot(figure, plots[i], i);
  });
})();
