// The growing picture: received tiles, zoom, pixel values, and an area that the user marks. A
// second canvas beside it shows a picture for comparison.
export class Picture {
  constructor(canvas, beside, { width, height }, onArea, onChange) {
    Object.assign(this, { width, height, onArea, onChange });
    this.views = [{ canvas, layer: "shown" }];
    this.beside = { canvas: beside, layer: "" };
    this.has = new Set();  // names of the layers that have data
    this.layers = Object.fromEntries(["shown", "sequential", "error"].map((name) => {
      const canvas = document.createElement("canvas"), image = new ImageData(width, height);
      for (let i = 3; i < image.data.length; i += 4) image.data[i] = 255;
      canvas.width = width;
      canvas.height = height;
      return [name, { canvas, image }];
    }));
    this.area = null;
    this.fit();
    this.listen(canvas);
    this.listen(beside);
  }

  // Selects the second picture: "sequential", "error", or "" for none.
  showBeside(layer) {
    this.beside.layer = layer;
    this.views.splice(1, 1, ...(layer ? [this.beside] : []));
    this.draw();
  }

  // Marks the area of the limits in force; an empty one covers the whole picture.
  mark(area) {
    this.area = area?.[2] > 0 ? area : null;
    this.draw();
  }

  // Adds tiles to a layer. Each is x, y, width and height as 16-bit numbers, then three bytes per
  // pixel.
  add(name, buffer) {
    const view = new DataView(buffer), bytes = new Uint8Array(buffer);
    const { canvas, image } = this.layers[name], context = canvas.getContext("2d"), { data } = image;
    this.has.add(name);
    for (let at = 0; at < buffer.byteLength;) {
      const [x, y, w, h] = [0, 2, 4, 6].map((i) => view.getUint16(at + i, true));
      at += 8;
      for (let j = 0; j < h; ++j) {
        let to = 4 * ((y + j) * this.width + x);
        for (const end = at + 3 * w; at < end; at += 3, to += 4) {
          data[to] = bytes[at];
          data[to + 1] = bytes[at + 1];
          data[to + 2] = bytes[at + 2];
        }
      }
      context.putImageData(image, 0, 0, x, y, w, h);
      if (this.has.has("sequential")) this.compare(x, y, w, h);
    }
    this.draw();
  }

  // Colours each pixel by its largest difference over the three channels: none is black, a quarter
  // of the range red, half yellow, all white.
  compare(x, y, w, h) {
    const { error } = this.layers, { data } = error.image;
    const a = this.layers.shown.image.data, b = this.layers.sequential.image.data;
    for (let j = y; j < y + h; ++j)
      for (let i = 4 * (j * this.width + x); i < 4 * (j * this.width + x + w); i += 4) {
        let most = 0;
        for (let c = i; c < i + 3; ++c) most = Math.max(most, Math.abs(a[c] - b[c]));
        data[i] = Math.min(255, 4 * most);
        data[i + 1] = Math.min(255, Math.max(0, 4 * (most - 64)));
        data[i + 2] = Math.min(255, Math.max(0, 2 * (most - 128)));
      }
    error.canvas.getContext("2d").putImageData(error.image, 0, 0, x, y, w, h);
  }

  fit() {
    this.zoom = 1;
    this.left = this.top = 0;
    this.draw();
  }

  // Zooms while the picture point (x, y) keeps its position on the screen.
  zoomBy(factor, x = this.left + this.width / this.zoom / 2,
    y = this.top + this.height / this.zoom / 2) {
    const zoom = Math.min(64, Math.max(1, this.zoom * factor));
    this.left = x - (x - this.left) * this.zoom / zoom;
    this.top = y - (y - this.top) * this.zoom / zoom;
    this.zoom = zoom;
    this.move(0, 0);
  }

  move(dx, dy) {
    const keep = (at, size) => Math.min(Math.max(0, at), size - size / this.zoom);
    this.left = keep(this.left + dx, this.width);
    this.top = keep(this.top + dy, this.height);
    this.draw();
    this.onChange?.();
  }

  draw() {
    for (const view of this.views) this.drawView(view);
  }

  drawView({ canvas, layer }) {
    const side = Math.ceil(640 / this.width);  // side of a picture pixel on the screen
    if (canvas.width !== side * this.width) {
      canvas.width = side * this.width;
      canvas.height = side * this.height;
    }
    const context = canvas.getContext("2d");
    context.imageSmoothingEnabled = false;
    const scale = canvas.width / this.width * this.zoom;
    context.setTransform(scale, 0, 0, scale, -this.left * scale, -this.top * scale);
    context.drawImage(this.layers[layer].canvas, 0, 0);
    const area = this.marking ?? this.area;
    if (!area) return;
    context.lineWidth = 3 / scale;
    context.strokeStyle = "#000";
    context.strokeRect(...area);
    context.lineWidth = 1.5 / scale;
    context.strokeStyle = "#f0e442";
    context.strokeRect(...area);
  }

  at(event) {
    const box = event.target.getBoundingClientRect();
    const limit = (v, most) => Math.min(most - 1, Math.max(0, Math.floor(v)));
    return [
      limit(this.left + (event.clientX - box.left) / box.width * this.width / this.zoom, this.width),
      limit(this.top + (event.clientY - box.top) / box.height * this.height / this.zoom,
        this.height)];
  }

  // Describes the values of a pixel in every visible picture.
  tell(x, y) {
    const at = 4 * (y * this.width + x);
    return this.views.map(({ layer }) => {
      const { data } = this.layers[layer === "error" ? "sequential" : layer].image;
      return data.subarray(at, at + 3).join(" ");
    });
  }

  listen(canvas) {
    let from = null, moved = null;
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      if (event.ctrlKey || event.button === 1) moved = [event.clientX, event.clientY];
      else from = this.at(event);
    });
    canvas.addEventListener("pointermove", (event) => {
      const [x, y] = this.at(event);
      this.pointed?.(x, y, this.tell(x, y));
      if (moved) {
        const scale = canvas.getBoundingClientRect().width / this.width * this.zoom;
        this.move((moved[0] - event.clientX) / scale, (moved[1] - event.clientY) / scale);
        moved = [event.clientX, event.clientY];
      }
      if (from) {
        this.marking = this.between(from, [x, y]);
        this.draw();
      }
    });
    canvas.addEventListener("pointerup", (event) => {
      moved = null;
      if (!from) return;
      const area = this.between(from, this.at(event));
      from = this.marking = null;
      if (area[2] > 1 || area[3] > 1) this.onArea(area);
      this.draw();
    });
    canvas.addEventListener("pointercancel", () => { from = moved = this.marking = null; });
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoomBy(event.deltaY < 0 ? 1.25 : 0.8, ...this.at(event));
    }, { passive: false });
    canvas.addEventListener("keydown", (event) => {
      const step = this.width / this.zoom / 10;
      const moves = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step],
        ArrowDown: [0, step] };
      if (moves[event.key]) this.move(...moves[event.key]);
      else if (event.key === "+") this.zoomBy(1.25);
      else if (event.key === "-") this.zoomBy(0.8);
      else return;
      event.preventDefault();
    });
  }

  between([x0, y0], [x1, y1]) {
    return [Math.min(x0, x1), Math.min(y0, y1), Math.abs(x1 - x0) + 1, Math.abs(y1 - y0) + 1];
  }
}
