// The page: says hello with the token of its address, asks for a frame when it has drawn the last,
// and says what the user's hands do.
import { Curves, TimeLine } from "/charts.js";
import { Machine } from "/machine.js";
import { Picture } from "/picture.js";

const $ = (id) => document.getElementById(id);
const SPEEDS = [1e-6, 1e-5, 1e-4, 1e-3, 0.01, 0.1, 0.5, 1, 2, 5, 10, 100, null];
const WINDOWS = [1e-4, 1e-3, 0.01, 0.1, 1, 10];
const kept = new URLSearchParams(location.hash.slice(1));  // what the address says

let socket, outline, state, picture, machine, line, curves;
let steers = false, asked = 0;
const replies = new Map();

// --- talking to the session -----------------------------------------------------------------------

function connect() {
  socket = new WebSocket(`ws://${location.host}/live`);
  socket.binaryType = "arraybuffer";
  socket.onopen = () => socket.send(JSON.stringify({ token: kept.get("token") ?? "" }));
  socket.onmessage = ({ data }) => {
    if (typeof data !== "string") return hearPicture(data);
    const message = JSON.parse(data);
    if (message.outline) begin(message.outline);
    if ("steers" in message) setSteering(message.steers);
    if ("reply" in message) hear(message);
    if (message.state) show(message.state);
  };
  socket.onclose = () => {
    $("status").textContent = outline ? "The session has ended; this is how it was."
      : "No session: open the address that tlab live printed.";
    document.querySelectorAll("button").forEach((button) => {
      if (!button.id.startsWith("zoom")) button.disabled = true;
    });
  };
}

function want() {
  if (socket.readyState === WebSocket.OPEN) socket.send(JSON.stringify({ want: "frame" }));
}

// Resolves when it was done or refused.
function ask(command) {
  const id = ++asked;
  socket.send(JSON.stringify({ id, ...command }));
  return new Promise((resolve) => replies.set(id, resolve));
}

function hear({ reply, refusal }) {
  $("refusal").textContent = refusal;
  $("refusal").hidden = !refusal;
  replies.get(reply)?.(refusal);
  replies.delete(reply);
}

function setSteering(value) {
  steers = value;
  $("steer").hidden = steers;
  document.body.classList.toggle("watches", !steers);
}

// The first byte says which picture it is: the display's, or the sequential one.
function hearPicture(data) {
  picture?.add(new Uint8Array(data, 0, 1)[0] === 0 ? "shown" : "sequential", data.slice(1));
}

// --- what is shown ----------------------------------------------------------------------------------

function begin(what) {
  outline = what;
  document.title = `${outline.title || outline.file} - tlab live`;
  $("title").textContent = outline.title || outline.file;
  if (outline.picture) {
    $("picture-part").hidden = false;
    picture = new Picture($("picture"), outline.picture, markArea, remember);
    picture.pointed = (x, y, [r, g, b]) => {
      $("pixel").textContent = `pixel ${x}, ${y}: ${r} ${g} ${b}`;
    };
    $("layer").closest("label").hidden = !outline.has_sequential;
    restoreView();
  }
  machine = new Machine($("machine"), outline, choose);
  machine.pointed = (found) => { $("pointed").textContent = found ? describe(found) : "\u00a0"; };
  line = new TimeLine($("line"), outline.processors);
  line.window = Number(kept.get("window")) || line.window;
  $("window").value = String(line.window);
  $("growth").replaceChildren();
  curves = new Curves($("growth"), outline.gauges);
  $("growth").parentElement.hidden = outline.gauges.length === 0;
  $("hands").hidden = !outline.has_user;
  if (outline.has_user) makeLimits();
  makeLoads();
  if (kept.get("processor") !== null) choose({ processor: Number(kept.get("processor")) });
  want();
}

const NAMES = { running: "running", paused: "paused", waiting: "waiting for your order",
  over: "over" };

function show(now) {
  state = now;
  $("status").textContent = `${NAMES[state.state]} at ${date(state.t_s)} of simulated time` +
    (state.phase ? `, ${state.phase}` : "") + tellFault();
  const announced = NAMES[state.state] + (state.phase ? ", " + state.phase : "") + tellFault();
  if ($("announced").textContent !== announced) $("announced").textContent = announced;
  $("go").textContent = state.state === "paused" ? "Go on" : "Pause";
  for (const id of ["go", "end", "run-date", "run-picture", "run-end"])
    $(id).disabled = state.state === "over";
  document.querySelectorAll("[data-step]").forEach((b) => { b.disabled = state.state === "over"; });
  $("quit").hidden = state.state !== "over";
  $("results").textContent = state.results ? `Results: ${state.results}` : "";
  if (document.activeElement !== $("speed")) $("speed").value = String(state.speed);
  machine.show(state);
  line.add(state);
  curves.add(state);
  showChosen();
  if ($("loads").closest("details").open) showLoads();
  requestAnimationFrame(want);
}

// The first line of why the run broke down, and who waits for whom.
function tellFault() {
  $("fault-part").hidden = !state.fault;
  if (!state.fault) return "";
  $("fault").textContent = state.fault;
  const cycle = state.deadlock.processes.join(" → ");
  return `: ${state.fault.split("\n")[0]}` + (cycle ? ` The cycle: ${cycle}.` : "");
}

// A date with all its microseconds.
const date = (s) => s < 1 ? `${(s * 1e3).toFixed(3)} ms` : `${s.toFixed(6)} s`;
const percent = (perMille) => `${(perMille / 10).toFixed(1)} %`;

function describe({ processor, link }) {
  if (link !== undefined) {
    const [a, b] = outline.links[link].map((id) => outline.processors[id].name);
    return `${a} to ${b}: ${percent(state.links[2 * link])}; back: ` +
      percent(state.links[2 * link + 1]);
  }
  return `${outline.processors[processor].name}: ${percent(state.cpus[processor])} busy, ` +
    `${state.queues[processor]} ready`;
}

// --- a processor or link that is chosen ---------------------------------------------------------------

function choose(found) {
  machine.chosen = found;
  if (steers || found?.processor === undefined)
    ask({ do: "select", processors: found?.processor === undefined ? [] : [found.processor] });
  remember();
  machine.draw();
  showChosen();
}

function element(name, text, attributes = {}) {
  const made = document.createElement(name);
  if (text !== undefined) made.textContent = text;
  Object.assign(made, attributes);
  return made;
}

let chosenText = "";
function showChosen() {
  const found = machine.chosen, detail = state?.details[found?.processor];
  const text = JSON.stringify([found, detail]);
  if (text === chosenText) return;
  chosenText = text;
  const parts = [];
  const ends = !found ? [] : found.link !== undefined ? outline.links[found.link]
    : [found.processor];
  if (found && ends.every((id) => outline.processors[id].may_break)) {
    const isLink = found.link !== undefined;
    const button = element("button", isLink ? "Cut this link" : "Stop this processor");
    button.onclick = () => ask(isLink ? { do: "fault", link: outline.links[found.link] }
      : { do: "fault", processor: found.processor });
    parts.push(button);
  }
  if (detail) {
    const share = detail.memory_bytes / detail.memory_size_bytes;
    parts.push(element("p", `${detail.name}: ${detail.memory_bytes} bytes of memory in use ` +
      `(${percent(1000 * share)})`));
    const table = element("table");
    const head = table.insertRow();
    for (const name of ["process", "priority", "state", "waits for"])
      head.append(element("th", name));
    for (const process of detail.processes) {
      const row = table.insertRow();
      for (const cell of [process.name, process.priority, process.state, process.waits_for])
        row.insertCell().textContent = cell;
    }
    parts.push(table);
  }
  $("chosen").replaceChildren(...parts);
}

function makeLoads() {
  const head = $("loads").createTHead().insertRow();
  for (const name of ["processor", "busy", "ready"]) head.append(element("th", name));
  $("loads").closest("details").ontoggle = showLoads;
}

function showLoads() {
  const body = $("loads").tBodies[0] ?? $("loads").createTBody();
  body.replaceChildren(...outline.processors.map((processor, i) => {
    const row = element("tr");
    for (const cell of [processor.name, percent(state.cpus[i]), state.queues[i]])
      row.append(element("td", cell));
    return row;
  }));
}

// --- orders ---------------------------------------------------------------------------------------------

function makeLimits() {
  const form = $("limits"), fields = [];
  for (const limit of outline.limits) {
    const id = "limit-" + limit.name;
    fields.push(element("label", limit.name.replaceAll("_", " "),
      { htmlFor: id, title: limit.help }));
    if (limit.range && limit.range[1] <= 1000) {
      const [low, high] = limit.range;
      const top = limit.whole ? Math.min(high, 64) : high;
      const slider = element("input", undefined, { type: "range", min: low, max: top,
        step: limit.whole ? 1 : 0.001, value: limit.value, ariaLabel: limit.name });
      const number = element("input", undefined, { id, type: "number", min: low, max: high,
        step: limit.whole ? 1 : "any", value: limit.value, name: limit.name });
      slider.oninput = () => { number.value = slider.value; };
      number.oninput = () => { slider.value = number.value; };
      slider.onchange = () => setLimits();
      fields.push(slider, number);
    } else {
      fields.push(element("input", undefined, { id, className: "text", name: limit.name,
        value: limit.value === null ? "" : String(limit.value), placeholder: limit.expected,
        title: limit.help }));
    }
  }
  form.replaceChildren(...fields);
  form.onsubmit = (event) => {
    event.preventDefault();
    setLimits();
  };
}

// The limits of the form as an order; what is left empty stays as it is by default.
function readLimits() {
  const order = {};
  for (const limit of outline.limits) {
    const text = $("limit-" + limit.name).value.trim();
    if (text === "") continue;
    if (limit.range) order[limit.name] = Number(text);
    else if (limit.expected.startsWith("one of")) order[limit.name] = text;
    else order[limit.name] = text.split(/[\s,]+/).map(Number);
  }
  return order;
}

async function give(order, text) {
  const at = state.t_s;
  if (await ask({ do: "order", order })) return;
  $("deeds").prepend(element("li", `${date(at)}: ${text}`));
}

function setLimits() {
  const order = readLimits();
  give(order, "limits " + JSON.stringify(order));
}

function markArea(area) {
  if (!outline.has_user) return;
  picture.area = area;
  $("limit-area").value = area.join(", ");
  setLimits();
}

// --- hands ------------------------------------------------------------------------------------------------

function options(select, values, spell) {
  select.replaceChildren(...values.map((value) =>
    element("option", spell(value), { value: String(value) })));
}

const seconds = (s) => s >= 1 ? `${s} s` : s >= 1e-3 ? `${+(s * 1e3).toPrecision(3)} ms`
  : `${+(s * 1e6).toPrecision(3)} µs`;

options($("speed"), SPEEDS, (x) => x === null ? "as fast as it goes" : `${seconds(x)} a second`);
options($("window"), WINDOWS, seconds);
options($("interval"), [0, ...WINDOWS], (s) => s === 0 ? "frame" : seconds(s));

const go = () => ask({ do: state.state === "paused" ? "go" : "pause" });
const step = (what) => ask({ do: "step", what });
const runTo = (to) => ask({ do: "run", to });
const setSpeed = (x) => ask({ do: "speed", x });
function changeSpeed(by) {
  const now = SPEEDS.findIndex((x) => x === null || x >= (state.speed ?? Infinity));
  setSpeed(SPEEDS[Math.min(SPEEDS.length - 1, Math.max(0, now + by))]);
}
async function save() {
  if (!await ask({ do: "save" }))
    $("deeds").prepend(element("li", `${date(state.t_s)}: the picture is saved`));
}

$("go").onclick = go;
document.querySelectorAll("[data-step]").forEach((button) => {
  button.onclick = () => step(button.dataset.step);
});
$("speed").onchange = () => setSpeed(JSON.parse($("speed").value));
$("run-date").onclick = () => runTo(Number($("date").value));
$("run-picture").onclick = () => runTo("picture");
$("run-end").onclick = () => runTo("end");
$("steer").onclick = () => socket.send(JSON.stringify({ do: "steer" }));
$("end").onclick = () => ask({ do: "end" });
$("quit").onclick = () => ask({ do: "quit" });
$("whole").onclick = () => {
  picture.area = null;
  $("limit-area").value = "";
  setLimits();
};
$("non-interactive").onclick = () => give({ non_interactive: true }, "non-interactive phase");
$("interactive").onclick = () => give({ interactive: true }, "interactive phase");
$("abort").onclick = () => give({ abort: true }, "abort");
$("save").onclick = save;
$("layer").onchange = () => {
  if ($("layer").value !== "shown") ask({ do: "compare" });
  picture.layer = $("layer").value;
  picture.draw();
};
$("zoom-in").onclick = () => picture.zoomBy(1.5);
$("zoom-out").onclick = () => picture.zoomBy(1 / 1.5);
$("zoom-fit").onclick = () => { picture.fit(); remember(); };
$("interval").onchange = () => ask({ do: "interval", s: Number($("interval").value) });
$("window").onchange = () => {
  line.window = Number($("window").value);
  line.draw();
  remember();
};

const KEYS = { " ": go, e: () => step("event"), m: () => step("message"), r: () => step("ray"),
  t: () => step("millisecond"), p: () => runTo("picture"), s: save, "[": () => changeSpeed(-1),
  "]": () => changeSpeed(1) };
document.addEventListener("keydown", (event) => {
  if (/^(INPUT|SELECT|TEXTAREA|BUTTON)$/.test(event.target.tagName)) return;
  if (event.ctrlKey || event.altKey || event.metaKey || !KEYS[event.key] || !state) return;
  event.preventDefault();
  KEYS[event.key]();
});

// --- the address keeps what is looked at --------------------------------------------------------------

function remember() {
  if (picture) kept.set("view", [picture.zoom, picture.left, picture.top].map((v) =>
    +v.toFixed(3)).join(","));
  if (line) kept.set("window", line.window);
  if (machine?.chosen?.processor !== undefined) kept.set("processor", machine.chosen.processor);
  else kept.delete("processor");
  history.replaceState(null, "", "#" + kept.toString());
}

function restoreView() {
  const view = kept.get("view")?.split(",").map(Number);
  if (view?.length !== 3 || !view.every(Number.isFinite)) return;
  [picture.zoom, picture.left, picture.top] = view;
  picture.move(0, 0);
}

window.tlabAsk = ask;  // for those who steer by a script
connect();
