// The hung views: zoom, level and window, and what scripts draw over them. Their base pictures and
// still marks stay where scripts do not run.
(function () {
  "use strict";
  const root = document.getElementById("views");
  if (!root) return;
  const MOST = 16;         // times as large
  const STEP = 1.25;       // of one key, click or notch
  const CLICK_PX = 4;      // a pointer that moved less has marked and not dragged
  const clamp = (value, low, high) => Math.min(Math.max(value, low), high);

  class Pane {
    constructor(view) {
      this.view = view;
      this.box = document.querySelector(".view[data-view='" + view.name + "']");
      this.content = this.box.querySelector(".content");
      this.canvas = document.createElement("canvas");
      this.canvas.tabIndex = 0;
      this.canvas.setAttribute("role", "img");
      this.canvas.setAttribute("aria-label", view.title + ": plus, minus and 0 zoom, arrow keys move, Enter marks the middle");
      this.box.append(this.canvas);
      this.zoom = 1;
      this.left = this.top = 0;  // of the content [CSS px]
      this.layers = new Map();
      this.listeners = [];
      this.listen();
      new ResizeObserver(() => this.update()).observe(this.box);
    }

    // CSS px in the pane of (u, v) [mm], and back.
    at([u, v]) {
      const { origin, along_u, along_v, width_mm } = this.view, scale = this.zoom * this.box.clientWidth / width_mm;
      return [this.left + scale * (origin[0] + u * along_u[0] + v * along_v[0]),
              this.top + scale * (origin[1] + u * along_u[1] + v * along_v[1])];
    }
    detector(x, y) {
      const { origin, along_u, along_v, width_mm } = this.view, scale = this.zoom * this.box.clientWidth / width_mm;
      const a = (x - this.left) / scale - origin[0], b = (y - this.top) / scale - origin[1];
      const det = along_u[0] * along_v[1] - along_u[1] * along_v[0];
      return [(a * along_v[1] - b * along_v[0]) / det, (b * along_u[0] - a * along_u[1]) / det];
    }

    show(layer, draw) {
      if (draw) this.layers.set(layer, draw); else this.layers.delete(layer);
      this.draw();
    }

    zoomBy(factor, x = this.box.clientWidth / 2, y = this.box.clientHeight / 2) {
      const zoom = clamp(this.zoom * factor, 1, MOST), by = zoom / this.zoom;
      this.left = x - by * (x - this.left);
      this.top = y - by * (y - this.top);
      this.zoom = zoom;
      this.update();
    }
    moveBy(dx, dy) {
      this.left += dx;
      this.top += dy;
      this.update();
    }

    update() {
      const width = this.box.clientWidth, height = this.box.clientHeight;
      this.left = clamp(this.left, width * (1 - this.zoom), 0);
      this.top = clamp(this.top, height * (1 - this.zoom), 0);
      this.content.style.transform = "translate(" + this.left + "px, " + this.top + "px) scale(" + this.zoom + ")";
      this.canvas.style.touchAction = this.zoom > 1 ? "none" : "manipulation";  // swipes scroll the page
      this.canvas.width = Math.round(width * devicePixelRatio);
      this.canvas.height = Math.round(height * devicePixelRatio);
      this.draw();
    }

    draw() {
      const context = this.canvas.getContext("2d");
      context.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
      context.clearRect(0, 0, this.box.clientWidth, this.box.clientHeight);
      for (const layer of this.layers.values()) layer(context, this);
    }

    mark(x, y) {
      const uv = this.detector(x, y);
      for (const listener of this.listeners) listener(uv);
    }

    listen() {
      const canvas = this.canvas;
      let down = null;
      canvas.addEventListener("pointerdown", event => {
        if (event.button !== 0) return;
        down = { x: event.offsetX, y: event.offsetY, moved: false };
        if (this.zoom > 1) canvas.setPointerCapture(event.pointerId);
      });
      canvas.addEventListener("pointermove", event => {
        if (!down) return;
        const dx = event.offsetX - down.x, dy = event.offsetY - down.y;
        if (!down.moved && Math.hypot(dx, dy) < CLICK_PX) return;
        down = { x: event.offsetX, y: event.offsetY, moved: true };
        if (this.zoom > 1) this.moveBy(dx, dy);
      });
      canvas.addEventListener("pointerup", event => {
        if (down && !down.moved) this.mark(event.offsetX, event.offsetY);
        down = null;
      });
      canvas.addEventListener("pointercancel", () => { down = null; });
      canvas.addEventListener("wheel", event => {
        if (document.activeElement !== canvas && !event.ctrlKey) return;  // the page scrolls until a view is chosen
        event.preventDefault();
        this.zoomBy(event.deltaY < 0 ? STEP : 1 / STEP, event.offsetX, event.offsetY);
      }, { passive: false });
      const keys = { "+": () => this.zoomBy(STEP), "-": () => this.zoomBy(1 / STEP), "0": () => this.zoomBy(0),
                     ArrowLeft: () => this.moveBy(40, 0), ArrowRight: () => this.moveBy(-40, 0),
                     ArrowUp: () => this.moveBy(0, 40), ArrowDown: () => this.moveBy(0, -40),
                     Enter: () => this.mark(this.box.clientWidth / 2, this.box.clientHeight / 2) };
      canvas.addEventListener("keydown", event => {
        if (!keys[event.key] || (event.key.startsWith("Arrow") && this.zoom === 1)) return;
        event.preventDefault();
        keys[event.key]();
      });
    }
  }

  // A line that is seen on any grey: the colour between a light and a dark edge.
  mammotwin.edged = (context, colour, width) => {
    context.lineJoin = context.lineCap = "round";
    for (const [style, more] of [["#000", 4], ["#fff", 2], [colour, 0]]) {
      context.strokeStyle = style;
      context.lineWidth = width + more;
      context.stroke();
    }
  };
  mammotwin.path = (context, pane, line) => {
    context.beginPath();
    line.forEach((uv, n) => n ? context.lineTo(...pane.at(uv)) : context.moveTo(...pane.at(uv)));
  };

  const data = JSON.parse(root.textContent);
  mammotwin.views = data;
  mammotwin.panes = new Map(data.views.map(view => [view.name, new Pane(view)]));

  const tools = document.getElementById("view-tools");
  tools.hidden = false;
  const each = act => mammotwin.panes.forEach(act);
  document.getElementById("zoom-in").addEventListener("click", () => each(pane => pane.zoomBy(STEP * STEP)));
  document.getElementById("zoom-out").addEventListener("click", () => each(pane => pane.zoomBy(1 / STEP / STEP)));
  document.getElementById("zoom-none").addEventListener("click", () => each(pane => pane.zoomBy(0)));

  // shown = (grey - level) / window + 1/2, of greys in [0, 1]
  const level = document.getElementById("grey-level"), width = document.getElementById("grey-window");
  const setGreys = () => {
    const slope = 100 / width.value, intercept = 0.5 - slope * level.value / 100;
    for (const channel of document.querySelectorAll("#greys feFuncR, #greys feFuncG, #greys feFuncB")) {
      channel.setAttribute("slope", slope);
      channel.setAttribute("intercept", intercept);
    }
    document.getElementById("lesions").classList.toggle("own-greys", slope !== 1 || intercept !== 0);
  };
  for (const slider of [level, width]) slider.addEventListener("input", setGreys);
})();
