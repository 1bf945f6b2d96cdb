// The live page. It authenticates with the token in its address, requests the next frame after
// drawing the last one, and sends the user's commands.
import { Curves, TimeLine, tellTime } from "/charts.js";
import { Machine } from "/machine.js";
import { Limits, describeAction, element } from "/orders.js";
import { Picture } from "/picture.js";

const $ = (id) => document.getElementById(id);
const SPEEDS = [1e-6, 1e-5, 1e-4, 1e-3, 0.01, 0.1, 0.5, 1, 2, 5, 10, 100, null];
const WINDOWS = [1e-4, 1e-3, 0.01, 0.1, 1, 10];
const MOST_ACTIONS = 1000;
const kept = new URLSearchParams(location.hash.slice(1));  // settings kept in the address

let socket, outline, state, picture, machine, line, curves, limits;
let steers = false, asked = 0;
// the simulated time to run to, as given in the address, until the first state arrives
let goesTo = NaN;
const replies = new Map();

// --- connection to the session ------------------------------------------------------------------

function connect() {
  socket = new WebSocket(`ws://${location.host}/live`);
  socket.binaryType = "arraybuffer";
  socket.onopen = () => socket.send(JSON.stringify({ token: kept.get("token") ?? "" }));
  socket.onmessage = ({ data }) => {
    if (typeof data !== "string") return hearPicture(data);
    const message = JSON.parse(data);
    if ("steers" in message) setSteering(message.steers);
    if (message.outline) begin(message.outline);
    if ("reply" in message) hear(message);
    if (message.history) hearHistory(message.history);
    if (message.state) show(message.state);
  };
  socket.onclose = () => {
    $("status").textContent = outline ? "The session has ended; the page shows its last state."
      : "No session: open the address that tlab live printed.";
    document.querySelectorAll("button").forEach((button) => {
      if (!button.id.startsWith("zoom")) button.disabled = true;
    });
  };
}

function want() {
  if (socket.readyState === WebSocket.OPEN) socket.send(JSON.stringify({ want: "frame" }));
}

// Sends a command. The promise resolves when the command has been executed or refused.
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

// Shows a received picture. Its first byte tells whether it is the display or the sequential
// rendering.
function hearPicture(data) {
  picture?.add(new Uint8Array(data, 0, 1)[0] === 0 ? "shown" : "sequential", data.slice(1));
}

// --- display ------------------------------------------------------------------------------------

function begin(what) {
  outline = what;
  const asked = new URLSearchParams(kept);
  document.title = `${outline.title || outline.file} - tlab live`;
  $("title").textContent = outline.title || outline.file;
  if (outline.picture) {
    $("picture-part").hidden = false;
    picture = new Picture($("picture"), $("beside"), outline.picture, markArea, remember);
    picture.pointed = (x, y, [shown, compared]) => {
      $("pixel").textContent = `pixel ${x}, ${y}: ${shown}` +
        (compared ? `, sequential ${compared}` : "");
    };
    $("layer").closest("label").hidden = !outline.has_sequential;
    restoreView(asked.get("view"));
  }
  else $("left").prepend($("machine-part"));
  machine = new Machine($("machine"), outline, choose);
  machine.pointed = (found) => { $("pointed").textContent = found ? describe(found) : "\u00a0"; };
  line = new TimeLine($("line"), outline.processors, showWindow);
  line.window = Number(asked.get("window")) || line.window;
  line.pointed = (text) => { $("span").textContent = text || "\u00a0"; };
  showWindow();
  $("growth").replaceChildren();
  curves = new Curves($("growth"), whatGrows());
  $("hands").hidden = !outline.has_user;
  if (outline.has_user)
    limits = new Limits($("limits"), outline.limits, give, (area) => picture?.mark(area));
  makeLoads();
  for (const what of ["processor", "link"]) {
    const number = Number(asked.get(what) ?? NaN), all = outline[what + "s"];
    if (number in all) choose({ [what]: number });
  }
  goesTo = Number(asked.get("t") ?? NaN);
  want();
}

// Lists the curves in the order of the values in the history.
function whatGrows() {
  return [...outline.gauges,
    { name: "mean load of the processors", help: "over the interval chosen above" },
    { name: "load of the busiest link", help: "one way, over the interval chosen above" },
    { name: "error of the picture",
      help: "root mean square difference from the sequential renderer's picture, as a share" }];
}

// Adds the part of the history that this page lacks.
function hearHistory(history) {
  curves.add(history);
  for (const action of history.actions)
    $("deeds").prepend(element("li", date(action.t_s) + ": " + describeAction(action, outline.processors)));
  while ($("deeds").children.length > MOST_ACTIONS) $("deeds").lastChild.remove();
}

// Selects a value in a list. Adds it if it is not among the choices.
function selectValue(select, value, spell) {
  select.querySelector("[data-own]")?.remove();
  if (![...select.options].some((option) => option.value === String(value))) {
    select.append(element("option", spell(value), { value: String(value) }));
    select.lastChild.dataset.own = "";
  }
  select.value = String(value);
}

function showWindow() {
  selectValue($("window"), line.window, tellTime);
  $("present").hidden = line.to === null;
  remember();
}

const NAMES = { running: "running", paused: "paused", waiting: "waiting for your order",
  over: "over" };

function show(now) {
  const was = state?.state;
  state = now;
  if (was !== state.state) remember();
  if (steers && state.state !== "over" && state.t_s < goesTo) runTo(goesTo);
  goesTo = NaN;
  machine.show(state);
  line.add(state);
  if (state.limits) limits?.show(state.limits);
  const fault = tellFault(), phase = state.phase ? ", " + state.phase : "";
  $("status").textContent =
    `${NAMES[state.state]} at ${date(state.t_s)} of simulated time${phase}${fault}`;
  const told = NAMES[state.state] + phase + fault + state.results;
  if (told !== toldLast) showSeldom(NAMES[state.state] + phase + fault);
  toldLast = told;
  if ($("speed").value !== String(state.speed) && document.activeElement !== $("speed"))
    selectValue($("speed"), state.speed, spellSpeed);
  showChosen();
  if ($("loads").closest("details").open) showLoads();
  requestAnimationFrame(want);
}

// Updates elements that rarely change, and only if they changed, since each assignment costs
// browser time.
let toldLast = "";
function showSeldom(announced) {
  if ($("announced").textContent !== announced) $("announced").textContent = announced;
  $("fault-part").hidden = !state.fault;
  $("fault").textContent = state.fault ?? "";
  $("go").textContent = state.state === "paused" ? "Go on" : "Pause";
  const controls = "#go, #end, [data-step], #speed, [id^=run-], #interval, #hands button, #hands input";
  document.querySelectorAll(controls).forEach((b) => { b.disabled = state.state === "over"; });
  $("quit").hidden = state.state !== "over";
  $("results").textContent = state.results ? `Results: ${state.results}` : "";
}

// The first line of the fault message, then the cycle of waiting processes.
function tellFault() {
  if (!state.fault) return "";
  const cycle = (state.deadlock?.processes ?? []).join(" → ");
  return `: ${state.fault.split("\n")[0]}` + (cycle ? ` The cycle: ${cycle}.` : "");
}

// Formats a simulated time with microsecond precision.
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

// --- the selected processor or link -------------------------------------------------------------

function choose(found) {
  machine.chosen = found;
  if (state?.state !== "over")
    ask({ do: "select", processors: found?.processor === undefined ? [] : [found.processor] });
  remember();
  machine.draw();
  showChosen();
}

let chosenText = "";
function showChosen() {
  const found = machine.chosen, detail = state?.details[found?.processor];
  const isOver = state?.state === "over", isCut = state?.cut.includes(2 * found?.link);
  const isStopped = state?.stopped.includes(found?.processor);
  const text = JSON.stringify([found, detail, isOver, isCut, isStopped]);
  if (text === chosenText) return;
  chosenText = text;
  const parts = [];
  const ends = !found ? [] : found.link !== undefined ? outline.links[found.link]
    : [found.processor];
  if (found?.link !== undefined)
    parts.push(element("p", "link " + ends.map((id) => outline.processors[id].name).join(" - ")));
  if (found && ends.every((id) => outline.processors[id].may_break)) {
    const isLink = found.link !== undefined;
    const button = element("button", isLink ? "Cut this link" : "Stop this processor",
      { disabled: isOver || isCut || isStopped });
    button.onclick = () => ask(isLink ? { do: "fault", link: outline.links[found.link] }
      : { do: "fault", processor: found.processor });
    parts.push(button);
  }
  if (detail) {
    const share = detail.memory_bytes / detail.memory_size_bytes;
    parts.push(element("p", `${detail.name}: ${detail.memory_bytes} bytes of memory in use ` +
      `(${percent(1000 * share)})`));
    if (detail.readings.length)
      parts.push(element("p", detail.readings.map(({ name, value }) =>
        `${name}: ${+value.toPrecision(6)}`).join("; ")));
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

// --- orders -------------------------------------------------------------------------------------

const give = (order) => ask({ do: "order", order });

function markArea(area) {
  if (!outline.has_user || state.state === "over") return;
  picture.area = area;
  limits.setArea(area.join(", "));
}

// --- controls -----------------------------------------------------------------------------------

function options(select, values, spell) {
  select.replaceChildren(...values.map((value) =>
    element("option", spell(value), { value: String(value) })));
}

const seconds = (s) => s >= 1 ? `${s} s` : s >= 1e-3 ? `${+(s * 1e3).toPrecision(3)} ms`
  : `${+(s * 1e6).toPrecision(3)} µs`;

const spellSpeed = (x) => x === null ? "as fast as possible" : `${seconds(x)} a second`;
options($("speed"), SPEEDS, spellSpeed);
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
const save = () => ask({ do: "save" });

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
  limits.setArea("");
};
$("non-interactive").onclick = () => give({ non_interactive: true });
$("interactive").onclick = () => give({ interactive: true });
$("abort").onclick = () => give({ abort: true });
$("save").onclick = save;
$("layer").onchange = () => {
  const layer = $("layer").value;
  if (layer && state.state !== "over") ask({ do: "compare" });
  $("beside-part").hidden = !layer;
  picture.showBeside(layer);
};
$("zoom-in").onclick = () => picture.zoomBy(1.5);
$("zoom-out").onclick = () => picture.zoomBy(1 / 1.5);
$("zoom-fit").onclick = () => { picture.fit(); remember(); };
$("interval").onchange = () => ask({ do: "interval", s: Number($("interval").value) });
$("window").onchange = () => line.zoomBy(Number($("window").value) / line.window);
$("present").onclick = () => line.moveTo(line.present);

const KEYS = { " ": go, e: () => step("event"), m: () => step("message"), r: () => step("ray"),
  t: () => step("millisecond"), p: () => runTo("picture"), s: save, "[": () => changeSpeed(-1),
  "]": () => changeSpeed(1) };
document.addEventListener("keydown", (event) => {
  if (/^(INPUT|SELECT|TEXTAREA)$/.test(event.target.tagName)) return;
  if (event.target.tagName === "BUTTON" && event.key === " ") return;
  if (event.ctrlKey || event.altKey || event.metaKey || !KEYS[event.key] || !state) return;
  if (state.state === "over") return;
  event.preventDefault();
  KEYS[event.key]();
});

// --- view settings in the address ---------------------------------------------------------------

// Delays updates of the address, since they are expensive.
let remembering;
function remember() {
  remembering ??= setTimeout(() => {
    remembering = undefined;
    writeAddress();
  }, 200);
}

function writeAddress() {
  if (picture) kept.set("view", [picture.zoom, picture.left, picture.top].map((v) =>
    +v.toFixed(3)).join(","));
  if (line) kept.set("window", line.window);
  for (const what of ["processor", "link"])
    if (machine?.chosen?.[what] !== undefined) kept.set(what, machine.chosen[what]);
    else kept.delete(what);
  if (state?.state === "paused") kept.set("t", state.t_s);
  else if (state) kept.delete("t");
  history.replaceState(null, "", "#" + kept.toString());
}

function restoreView(text) {
  const view = text?.split(",").map(Number);
  if (view?.length !== 3 || !view.every(Number.isFinite)) return;
  [picture.zoom, picture.left, picture.top] = view;
  picture.move(0, 0);
}

window.tlabAsk = ask;  // lets scripts steer the run
connect();
