// The user's orders: a form for the limits of the interactive phase, and the list of actions so far.

export function element(name, text, attributes = {}) {
  const made = document.createElement(name);
  if (text !== undefined) made.textContent = text;
  Object.assign(made, attributes);
  return made;
}

const spell = (value) => Array.isArray(value) ? value.join(", ") : value ?? "";

export class Limits {
  // `give` sends an order; `onArea` is called with the area in force.
  constructor(form, limits, give, onArea) {
    Object.assign(this, { form, limits, give, onArea });
    this.shown = "";
    this.isEdited = false;
    form.replaceChildren(...limits.flatMap((limit) => this.makeFields(limit)));
    form.oninput = () => { this.isEdited = true; };
    form.onsubmit = (event) => {
      event.preventDefault();
      this.set();
    };
  }

  field(name) { return this.form.elements[name]; }

  // The elements of a limit: a label and a text field, or a label, a slider and a number.
  makeFields({ name, help, whole, range, expected }) {
    const id = "limit-" + name;
    const label = element("label", name.replaceAll("_", " "), { htmlFor: id, title: help });
    if (!range || range[1] > 1000)
      return [label, element("input", undefined,
        { id, name, className: "text", placeholder: expected, title: help })];
    const [low, high] = range, type = "range", top = whole ? Math.min(high, 64) : high;
    const slider = element("input", undefined, { type, min: low, max: top,
      step: whole ? 1 : 0.001, ariaLabel: name });
    const number = element("input", undefined, { id, name, type: "number", min: low, max: high,
      step: whole ? 1 : "any" });
    slider.oninput = () => { number.value = slider.value; };
    number.oninput = () => { slider.value = number.value; };
    slider.onchange = () => this.set();
    return [label, slider, number];
  }

  // Shows the limits in force, unless the user is changing them.
  show(values) {
    const text = JSON.stringify(values);
    if (text === this.shown || this.isEdited) return;
    this.shown = text;
    this.limits.forEach(({ name }, i) => {
      const field = this.field(name), slider = field.previousElementSibling;
      const isWhole = name === "area" && !(values[i]?.[2] > 0);
      field.value = isWhole ? "" : spell(values[i]);
      if (slider.type === "range") slider.value = values[i];
      if (name === "area") this.onArea(values[i]);
    });
  }

  // Reads the form as an order. Empty fields keep their defaults.
  read() {
    const order = {};
    for (const { name, range, expected } of this.limits) {
      const text = this.field(name).value.trim();
      if (text === "") continue;
      if (range) order[name] = Number(text);
      else if (expected.startsWith("one of")) order[name] = text;
      else order[name] = text.split(/[\s,]+/).map(Number);
    }
    return order;
  }

  set() {
    this.isEdited = false;
    this.give(this.read());
  }

  setArea(text) {
    this.field("area").value = text;
    this.set();
  }
}

// Describes an action in the history: an order or a fault.
const ORDERS = { non_interactive: "non-interactive phase", interactive: "interactive phase",
  abort: "abort", leave: "no further orders" };
export function describeAction({ order, link, processor }, processors) {
  if (link) return `link ${link.map((id) => processors[id].name).join(" - ")} cut`;
  if (processor !== undefined) return `${processors[processor].name} stopped`;
  if (order.save) return `picture saved as ${order.save}`;
  const [key] = Object.keys(order);
  return ORDERS[key] ?? Object.entries(order).map(([name, value]) =>
    `${name.replaceAll("_", " ")} ${spell(value)}`).join("; ");
}
