// Interactive parts of a report: plots that show values and points, and tables that can be sorted
// and folded. Without this script the page shows static plots and complete tables.
"use strict";
(() => {
  const {plots, points} =
      JSON.parse(document.querySelector('script[type="application/json"]').textContent);

  // ---- Page elements ----

  function make(name, attributes, ...children) {
    const element = document.createElement(name);
    for (const [key, value] of Object.entries(attributes ?? {}))
      if (value !== undefined) element.setAttribute(key, value);
    element.append(...children);
    return element;
  }
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

  // ---- Lines and symbols of series ----

  // Symbols of Look: disc, square, triangle, diamond, triangle down, pentagon, cross, plus, star,
  // and a ring for marks
  const SYMBOLS = [
    "M-4,0A4,4 0 1 1 4,0A4,4 0 1 1 -4,0Z", "M-4,-4H4V4H-4Z", "M0,-5L4.33,2.5H-4.33Z",
    "M0,-5L5,0L0,5L-5,0Z", "M0,5L-4.33,-2.5H4.33Z",
    "M0,-5L4.76,-1.55L2.94,4.05H-2.94L-4.76,-1.55Z", "M-4,-4L4,4M-4,4L4,-4", "M-5,0H5M0,-5V5",
    "M-4,-4L4,4M-4,4L4,-4M-5,0H5M0,-5V5", "M-9,0A9,9 0 1 1 9,0A9,9 0 1 1 -9,0Z",
  ];
  const MARK = {kind: "mark", colour: "#000", symbol: 9};
  const NEUTRAL = {colour: "#404040", symbol: 0};  // for all curves
  // widths of lines, in pixels
  const WIDTHS = {curve: 2, law: 1, ideal: 1.5, reference: 0, mark: 0, saturated: 0};
  const IDEAL = {name: "ideal", kind: "ideal", colour: "#707070", dashes: "9,5", points: []};
  const LAWS = {
    "Amdahl's law": {dashes: "7,3,2,3", at: (serial, n) => 1 / (serial + (1 - serial) / n)},
    "Gustafson's law": {dashes: "2,3", at: (serial, n) => n + (1 - n) * serial},
  };
  const split = dashes => dashes ? dashes.split(",").map(Number) : [];

  function paintLine(context, points, colour, width, dashes) {
    context.beginPath();
    for (const [x, y] of points) context.lineTo(x, y);
    Object.assign(context, {strokeStyle: colour, lineWidth: width});
    context.setLineDash(split(dashes));
    context.stroke();
  }

  // Paints the filled symbol of a curve, or an open one. Beyond saturation, the symbol is hollow,
  // and covers the filled one; a disc replaces symbols without an area. Steps have no symbols.
  function paintSymbol(context, {kind, colour, symbol, steps}, x, y) {
    if (steps) return;
    const isHollow = kind === "saturated", isOpen = kind !== "curve" || symbol > 5;
    const path = new Path2D(SYMBOLS[isHollow && symbol > 5 ? 0 : symbol]);
    context.save();
    context.translate(x, y);
    context.setLineDash([]);
    Object.assign(context, {fillStyle: colour, strokeStyle: colour, lineWidth: isOpen ? 2 : 0.5});
    if (isHollow) context.fillStyle = "#fff";
    if (isHollow || !isOpen) context.fill(path);
    context.stroke(path);
    context.restore();
  }

  function makeSwatch(s) {
    const swatch = make("canvas", {width: 68, height: 40, "aria-hidden": true});
    const context = swatch.getContext("2d"), width = WIDTHS[s.kind];
    context.scale(2, 2);
    if (width)
      paintLine(context, [[1, 10], [33, 10]], s.colour, width, s.kind !== "law" && s.dashes);
    if (s.kind !== "law" && s !== IDEAL)
      paintSymbol(context, s.kind === "saturated" ? {...s, ...NEUTRAL} : s, 17, 10);
    return swatch;
  }

  // ---- A plot: charts of dygraphs, with buttons, a legend, and details of points ----

  // The points of all series by x, each with its series, the number k of that, and its band.
  const listPoints = series => series.flatMap((s, k) => s.points.map(([x, y, point]) => {
    const [, low, high] = s.band?.find(band => band[0] === x) ?? [x, y, y];
    return {s, k, x, y, point, low, high};
  })).sort((a, b) => a.x - b.x);

  class Plot {
    constructor(still, {title, x, y, ideal, series, difference, legend, laws = []}) {
      Object.assign(this, {x, y, laws, legend, log: {x: x.log, y: y.log}});
      const all = series.map(s => s.kind === "mark" ? {...s, ...MARK} : s);
      this.series = ideal ? [IDEAL, ...all] : all;
      this.curves = series.filter(s => s.kind === "curve");
      this.hidden = new Set();  // hidden entries of the legend
      this.chosenLaws = undefined;  // names of the visible laws, once the user has selected some
      this.states = [];  // functions that show states on the page
      const told = series.filter(s => s.kind === "curve" || s.kind === "reference");
      this.panels = [{series: told, label: y.label}, difference ?? []].flat();
      for (const panel of this.panels)
        Object.assign(panel, {all: listPoints(panel.series), box: make("div", {class: "panel"})});
      this.xs = [...new Set(this.panels[0].all.map(at => at.x))];
      this.build(still, title);
      this.update(true);
    }

    build(still, title) {
      still.classList.add("still");
      const tools = make("div", {class: "tools", role: "toolbar", "aria-label": "axes and laws"});
      const key = make("div", {class: "legend", role: "group", "aria-label": "curves"});
      const caption = `${still.getAttribute("aria-label")}. Arrow keys go from point to point, ` +
          "Enter tells how busy the machine was.";
      this.stage = make("div", {class: "stage", tabindex: 0, role: "application",
                                "aria-label": caption}, ...this.panels.map(({box}) => box));
      this.said = make("div", {class: "said", "aria-live": "polite"});
      this.details = make("div");
      still.after(make("p", {class: "title"}, title), tools, this.stage, key, this.said,
                  this.details);
      this.stage.addEventListener("blur", () => this.panels[0].graph.clearSelection());
      this.stage.addEventListener("keydown", event => this.press(event));
      this.addTools(tools);
      this.addEntries(key, this.series.filter(s => s.name));
    }

    // Adds a button. `is` tells whether it is pressed. `click` returns true to undo zooms.
    addButton(bar, text, title, is, click) {
      const button = makeButton(text, title, event => this.update(click(event)));
      if (is) this.states.push(() => button.setAttribute("aria-pressed", is()));
      bar.append(button);
      return button;
    }

    addTools(bar) {
      for (const axis of ["x", "y"]) {
        const title = `${unitless(this[axis].label)}: logarithmic or linear`;
        const button = this.addButton(bar, `log ${axis}`, title, () => this.log[axis], () => {
          this.log[axis] = !this.log[axis];
          return true;
        });
        button.disabled = !this.log[axis] && this.panels[0].all.some(at => at[axis] <= 0);
      }
      for (const law of new Set(this.laws.map(l => l.law)))
        this.addButton(bar, law, `${law}, fitted to each curve`, () => this.has(law), () => {
          this.chosenLaws = Object.keys(LAWS).filter(l => this.has(l) !== (l === law));
        });
      this.addButton(bar, "whole plot", "undo zooms; drag over the plot to zoom", null, () => true);
    }

    addEntries(bar, entries) {
      bar.hidden = entries.length === 0;
      if (this.legend && entries.length) bar.append(make("span", {class: "axes"}, `${this.legend}:`));
      for (const s of entries) {
        const title = "on and off; with Shift: this one alone";
        const button = this.addButton(bar, "", title, () => !this.hidden.has(s), event => {
          const isAlone = entries.every(t => (t === s) !== this.hidden.has(t));
          if (event.shiftKey) this.hidden = new Set(isAlone ? [] : entries.filter(t => t !== s));
          else if (!this.hidden.delete(s)) this.hidden.add(s);
        });
        const text = make("span", {class: "serial"});
        button.append(makeSwatch(s), make("span", {}, s.name), text);
        this.states.push(() => {
          text.textContent = this.laws.filter(l => this.curves[l.of] === s && this.has(l.law)).map(
              l => ` · ${l.law.split("'")[0]} s = ${l.serial.toPrecision(3)}`).join("");
        });
      }
    }

    // True for a visible law. Until the user selects laws, they are visible on linear axes, where
    // their shapes are familiar.
    has(law) {
      return this.chosenLaws?.includes(law) ??
          (!this.log.x && !this.log.y && this.curves.length <= 3);
    }

    // The entry of the legend shows or hides a series. So does the entry of its curve.
    isShown(s) {
      const entry = s.name ? s : this.series.find(t => t.name && t.kind === s.kind);
      return !this.hidden.has(entry) && !this.hidden.has(this.curves[s.of]);
    }

    // "beyond saturation" for a point of a curve that is, else "".
    nameSaturation({s, x}) {
      const isBeyond = this.series.some(t => t.kind === "saturated" && this.curves[t.of] === s &&
          t.points.some(point => point[0] === x));
      return isBeyond ? ", beyond saturation" : "";
    }

    // ---- The chart ----

    update(isWhole) {
      for (const show of this.states) show();
      for (const panel of this.panels) {
        const options = this.choose(panel);
        if (isWhole) options.dateWindow = this.xRange();
        if (panel.graph) panel.graph.updateOptions(options);
        else panel.graph = new Dygraph(panel.box, options.file, {...this.style(panel), ...options});
      }
    }

    xRange() {
      const [to, from] = this.log.x ? [Math.log, Math.exp] : [x => x, x => x];
      const xs = this.xs.map(to).filter(Number.isFinite), low = xs[0], high = xs.at(-1);
      const margin = 0.04 * (high - low) || 0.5;
      return [from(low - margin), from(high + margin)];
    }

    // Chooses limits of y, null for those of the points. The ideal line extends the axis, but does
    // not flatten the curves. An axis of differences includes 0.
    yRange({rows}, isUpper) {
      const {log, y: {min, max}} = this, highest = Math.max(0, ...rows.map(at => at.high));
      if (!isUpper) {
        const lowest = Math.min(0, ...rows.map(at => at.y));
        const margin = Math.max(0.1 * (highest - lowest), 0.5);
        return [lowest - margin, highest + margin];
      }
      if (log.y && highest === 0) return [1, 10];
      if (highest > 0 && this.series.includes(IDEAL) && this.isShown(IDEAL))
        return [null, 1.05 * Math.min(2.5 * highest, Math.max(highest, this.xs.at(-1)))];
      return log.y ? [null, null] : [min || null, max ?? null];
    }

    // Puts ticks at the points if x is logarithmic and there are few, or else where dygraphs does.
    tickX(low, high, pixels, options, graph) {
      const xs = this.log.x ? this.xs.filter(x => x >= low && x <= high) : [];
      const every = Math.ceil(xs.length * options("pixelsPerLabel") / pixels);
      const isOwn = xs.length > 1 && (every === 1 || xs.every(x => Number.isInteger(Math.log2(x))));
      return Dygraph.numericTicks(low, high, pixels, options, graph,
                                  isOwn ? xs.filter((_, i) => i % every === 0) : undefined);
    }

    // Chooses options that depend on the axes and the visible series. Each visible point is a row.
    choose(panel) {
      const isUpper = panel === this.panels[0], logX = this.log.x, logY = isUpper && this.log.y;
      panel.rows = panel.all.filter(
          ({s, x, y}) => this.isShown(s) && (!logX || x > 0) && (!logY || y > 0));
      const file = panel.rows.map(({k, x, y, low, high}) => [
        x, ...panel.series.map((_, i) => i === k ? [logY && low <= 0 ? y : low, y, high] : null)]);
      if (file.length === 0) file.push([this.xs[0], ...panel.series.map(() => null)]);
      return {
        file, yRangePad: logY ? 10 : null, includeZero: this.y.min === 0 || this.y.log,
        axes: {
          x: {logscale: logX, ticker: (...range) => this.tickX(...range), axisLabelFormatter: tell,
              pixelsPerLabel: 55, axisLabelWidth: 56, drawAxis: panel === this.panels.at(-1)},
          y: {logscale: logY, axisLabelFormatter: tell, axisLabelWidth: 64, pixelsPerLabel: 25,
              valueRange: this.yRange(panel, isUpper)},
        },
      };
    }

    style(panel) {
      const escape = text => make("i", {}, text).innerHTML;
      return {
        labels: ["x", ...panel.series.map((_, k) => String(k))], ylabel: escape(panel.label),
        xlabel: panel === this.panels.at(-1) ? escape(this.x.label) : "", rightGap: 20,
        customBars: true, connectSeparatedPoints: true, drawPoints: true, resizable: "passive",
        axisLabelFontSize: 13, gridLineColor: "#d8d8d8", gridLineWidth: 0.8,
        series: Object.fromEntries(panel.series.map((s, k) => [k, {
          color: s.colour, strokeWidth: WIDTHS[s.kind], strokePattern: split(s.dashes),
          stepPlot: Boolean(s.steps),
          fillAlpha: s.bars ? 0 : 0.15,
          drawPointCallback: (graph, name, context, x, y) => paintSymbol(context, s, x, y)}])),
        plugins: [{activate: () => ({didDrawChart: event => this.paintOver(panel, event)})}],
        // The nearest point is selected. Its series keeps its look.
        highlightSeriesOpts: {}, highlightSeriesBackgroundAlpha: 1,
        drawHighlightPointCallback: (graph, name, context, x, y) => {
          paintLine(context, [[x, 0], [x, panel.box.clientHeight]], "#707070", 1);
          paintSymbol(context, MARK, x, y);
        },
        legend: "follow", legendFollowOffsetX: 14, legendFollowOffsetY: 0,
        legendFormatter: ({i}) => this.makeTip(panel, panel.chosen = panel.rows[i]),
        clickCallback: () => this.open(panel),
        zoomCallback: (low, high) => {
          for (const {graph} of this.panels.filter(other => other !== panel))
            graph.updateOptions({dateWindow: [low, high]});
        },
        // Only zooms. Without touch events, a finger scrolls the page.
        interactionModel: {
          mousedown: (event, ...more) => event.shiftKey || event.altKey ||
              Dygraph.defaultInteractionModel.mousedown(event, ...more),
          dblclick: () => this.update(true), willDestroyContextMyself: true},
      };
    }

    // Paints what is no series of dygraphs: the line y = 0, laws, and marks.
    paintOver(panel, {dygraph: graph, drawingContext: context}) {
      const [low, high] = graph.xAxisRange(), {x: left, w: width} = graph.getArea();
      // toDomXCoord() of dygraphs ignores logarithmic axes
      const place = ([x, y]) => [left + width * graph.toPercentXCoord(x), graph.toDomYCoord(y)];
      const line = (points, ...look) => paintLine(context, points.map(place), ...look);
      line([[low, 0], [high, 0]], "#707070", 1);
      for (const {s, x, y, low: from, high: to} of panel.rows.filter(
          at => at.s.bars && at.low < at.high)) {
        const isCut = panel === this.panels[0] && this.log.y && from <= 0;
        const [across, lower] = place([x, isCut ? y : from]), [, upper] = place([x, to]);
        for (const ends of [[[across, lower], [across, upper]],
                            [[across - 4, lower], [across + 4, lower]],
                            [[across - 4, upper], [across + 4, upper]]])
          paintLine(context, ends, s.colour, 1.5);
      }
      if (panel !== this.panels[0]) return;
      const xs = Array.from({length: 201}, (_, i) => this.log.x
          ? low * (high / low) ** (i / 200) : low + (high - low) * i / 200).filter(x => x > 0);
      for (const {law, of, serial} of this.laws.filter(l => this.has(l.law)))
        if (this.isShown(this.curves[of]))
          line(xs.map(x => [x, LAWS[law].at(serial, x)]), this.curves[of].colour, WIDTHS.law,
               LAWS[law].dashes);
      for (const s of this.series.filter(t => this.isShown(t))) {
        if (s === IDEAL) line(xs.map(x => [x, x]), s.colour, WIDTHS.ideal, s.dashes);
        if (s.kind === "law") line(s.points, s.colour, WIDTHS.law);
        if (s.kind === "mark" || s.kind === "saturated")
          for (const p of s.points) paintSymbol(context, s, ...place(p));
      }
    }

    // Lists the values at the x of the selected point.
    makeTip(panel, chosen) {
      const tip = new DocumentFragment();
      if (!chosen) return tip;
      tip.append(make("div", {}, `${this.x.label} ${tell(chosen.x)}`));
      for (const at of panel.rows.filter(({x}) => x === chosen.x).sort((a, b) => b.y - a.y))
        tip.append(make("div", {class: at === chosen ? "this" : undefined}, makeSwatch(at.s),
                        `${at.s.full || at.s.name || unitless(panel.label)} `, make("b", {}, tell(at.y)),
                        at.s.bars && at.low < at.high ? ` ± ${tell((at.high - at.low) / 2)}` : "",
                        this.nameSaturation(at)));
      if (points[chosen.point]?.loads.length)
        tip.append(make("div", {class: "hint"}, "click: why"));
      return tip;
    }

    press(event) {
      const [panel] = this.panels, {rows, chosen, graph} = panel;
      if (event.key === "Escape") {
        graph.clearSelection();
        this.details.replaceChildren();
      }
      const isEnter = event.key === "Enter" || event.key === " ";
      const step = {ArrowRight: ["x", 1], ArrowLeft: ["x", -1], ArrowUp: ["y", 1],
                    ArrowDown: ["y", -1]}[event.key];
      if (isEnter || step) event.preventDefault();
      if (isEnter) this.open(panel, true);
      if (!step || rows.length === 0) return;
      const [axis, way] = step, now = chosen ?? rows[0];
      const near = rows.filter(({k, x}) => axis === "x" ? k === now.k : x === now.x)
                       .sort((a, b) => a[axis] - b[axis]);
      const next = near[near.indexOf(now) + (chosen ? way : 0)] ?? now, {s, k, x, y} = next;
      graph.setSelection(rows.indexOf(next), String(k));
      this.said.textContent =
          `${s.name ? (s.full || s.name) + ", " : ""}${this.x.label} ${tell(x)}: ${panel.label} ${tell(y)}` +
          this.nameSaturation(next);
    }

    // Shows the details of the selected point. `goes` moves the focus there.
    open({chosen}, goes) {
      const leave = () => {
        this.details.replaceChildren();
        this.stage.focus({preventScroll: true});
      };
      leave();
      if (points[chosen?.point] === undefined) return;
      const box = this.details.appendChild(makeDetails(chosen.point, leave));
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
  document.querySelectorAll("figure.plot > svg").forEach((still, i) => {
    if (plots[i]) new Plot(still, plots[i]);
  });
})();
