// Three linked planes through the MRI with its labels, drawn in plain canvases; the still pictures
// stay where the browser cannot inflate the image.
(function () {
  "use strict";
  const root = document.getElementById("planes");
  if (typeof DecompressionStream === "undefined") return;
  const volume = JSON.parse(document.getElementById("volume").textContent);
  const [nx, ny, nz] = volume.size;
  const step = [1, nx, nx * ny];

  // An axis of the patient that grows to the right and one that grows (or falls) downwards.
  const PLANES = [
    { name: "Axial", normal: 2, right: 0, down: 1, falls: false, ends: ["R", "L", "A", "P"] },
    { name: "Sagittal", normal: 0, right: 1, down: 2, falls: true, ends: ["A", "P", "S", "I"] },
    { name: "Coronal", normal: 1, right: 0, down: 2, falls: true, ends: ["R", "L", "S", "I"] },
  ];
  const LETTERS = ["L", "P", "S"];
  const LESION = "rgb(" + volume.mark.join() + ")", CROSS = "rgba(255, 255, 255, .6)";
  const NEAR_MM = 6;  // a place is ringed on slices that pass this close

  const clamp = (value, low, high) => Math.min(Math.max(value, low), high);
  const position = (axis, index) => volume.origin[axis] + volume.spacing[axis] * index;
  const voxel = at => at.map((x, axis) =>
    clamp(Math.round((x - volume.origin[axis]) / volume.spacing[axis]), 0, volume.size[axis] - 1));
  const shown = (axis, index) => LETTERS[axis] + " " + position(axis, index).toFixed(1).replace("-", "−");

  let grey = null, labels = null, curve = [], cursor = voxel(volume.places.length ? volume.places[0].at
    : volume.size.map((n, axis) => position(axis, n / 2)));
  const colours = new Map(volume.tissues.map(t => [t.value, t.colour]));
  const names = new Map(volume.tissues.map(t => [t.value, t.name]));
  const strength = document.getElementById("planes-labels");
  const status = document.getElementById("planes-status");

  // The slice through the cursor, a pixel a voxel.
  function slice(plane) {
    const width = volume.size[plane.right], height = volume.size[plane.down];
    const image = plane.memory.getContext("2d").createImageData(width, height);
    const alpha = strength.value / 100;
    for (let row = 0; row < height; ++row) {
      const down = plane.falls ? height - 1 - row : row;
      let from = cursor[plane.normal] * step[plane.normal] + down * step[plane.down];
      for (let column = 0, to = 4 * row * width; column < width; ++column, to += 4, from += step[plane.right]) {
        const g = grey ? grey[from] : 40, colour = colours.get(labels[from]);
        for (let c = 0; c < 3; ++c) image.data[to + c] = colour ? g + alpha * (colour[c] - g) : g;
        image.data[to + 3] = 255;
      }
    }
    plane.memory.getContext("2d").putImageData(image, 0, 0);
  }

  // Canvas coordinates of a voxel index along the plane's axes.
  const across = (plane, index) => (index + 0.5) / volume.size[plane.right] * plane.canvas.width;
  const downwards = (plane, index) => {
    const n = volume.size[plane.down];
    return ((plane.falls ? n - 1 - index : index) + 0.5) / n * plane.canvas.height;
  };

  function drawCross(plane, context) {
    const x = across(plane, cursor[plane.right]), y = downwards(plane, cursor[plane.down]);
    context.strokeStyle = CROSS;
    context.lineWidth = devicePixelRatio;
    context.beginPath();
    context.moveTo(x, 0);
    context.lineTo(x, plane.canvas.height);
    context.moveTo(0, y);
    context.lineTo(plane.canvas.width, y);
    context.stroke();
  }

  function drawPlaces(plane, context) {
    const scale = plane.canvas.width / (volume.size[plane.right] * volume.spacing[plane.right]);
    context.fillStyle = "#fff";
    context.font = "600 " + 13 * devicePixelRatio + "px system-ui, sans-serif";
    context.textAlign = "start";
    for (const place of volume.places) {
      const away = place.at[plane.normal] - position(plane.normal, cursor[plane.normal]);
      if (Math.abs(away) > NEAR_MM) continue;
      const index = place.at.map((x, axis) => (x - volume.origin[axis]) / volume.spacing[axis]);
      const x = across(plane, index[plane.right]), y = downwards(plane, index[plane.down]);
      context.beginPath();
      context.arc(x, y, 7 * scale, 0, 2 * Math.PI);
      for (const [colour, width] of [["#000", 6], ["#fff", 4], [LESION, 2]]) {
        context.strokeStyle = colour;
        context.lineWidth = width * devicePixelRatio;
        context.stroke();
      }
      const name = place.name.replace("Lesion ", ""), right = plane.canvas.width - context.measureText(name).width;
      const left = Math.min(x + 8 * scale, right), base = Math.max(y - 4 * scale, 13 * devicePixelRatio);
      context.lineWidth = 3 * devicePixelRatio;
      context.strokeStyle = "#000";
      context.strokeText(name, left, base);
      context.fillText(name, left, base);
    }
  }

  // The places of a mark on a view, each as a line where the slice passes it and faint elsewhere.
  function drawCurve(plane, context) {
    if (curve.length < 2) return;
    const at = x => {
      const index = x.map((value, axis) => (value - volume.origin[axis]) / volume.spacing[axis]);
      return [across(plane, index[plane.right]), downwards(plane, index[plane.down])];
    };
    const near = x => Math.abs(x[plane.normal] - position(plane.normal, cursor[plane.normal])) <= NEAR_MM;
    for (const [wanted, alpha] of [[false, 0.45], [true, 1]]) {
      context.globalAlpha = alpha;
      context.beginPath();
      for (let n = 0; n + 1 < curve.length; ++n) {
        if (near(curve[n]) !== wanted) continue;
        context.moveTo(...at(curve[n]));
        context.lineTo(...at(curve[n + 1]));
      }
      for (const [colour, width] of [["#000", 5], ["#fff", 3.5], [volume.curve, 2]]) {
        context.strokeStyle = colour;
        context.lineWidth = width * devicePixelRatio;
        context.stroke();
      }
    }
    context.globalAlpha = 1;
  }

  function drawEnds(plane, context) {
    const w = plane.canvas.width, h = plane.canvas.height, r = devicePixelRatio;
    context.fillStyle = "#fff";
    context.textAlign = "center";
    context.font = "600 " + 12 * r + "px system-ui, sans-serif";
    [[9, h / r / 2], [w / r - 9, h / r / 2], [w / r / 2, 14], [w / r / 2, h / r - 6]].forEach(([x, y], i) =>
      context.fillText(plane.ends[i], x * r, y * r));
  }

  function draw(plane) {
    const canvas = plane.canvas, context = canvas.getContext("2d");
    canvas.width = Math.round(canvas.clientWidth * devicePixelRatio);
    canvas.height = Math.round(canvas.clientHeight * devicePixelRatio);
    slice(plane);
    context.drawImage(plane.memory, 0, 0, canvas.width, canvas.height);
    drawCross(plane, context);
    drawPlaces(plane, context);
    drawCurve(plane, context);
    drawEnds(plane, context);
    plane.slider.value = cursor[plane.normal];
    plane.slider.setAttribute("aria-valuetext", shown(plane.normal, cursor[plane.normal]) + " mm");
    plane.output.textContent = shown(plane.normal, cursor[plane.normal]) + " mm";
  }

  function update() {
    PLANES.forEach(draw);
    const value = labels[cursor.reduce((sum, index, axis) => sum + index * step[axis], 0)];
    status.textContent = cursor.map((index, axis) => shown(axis, index)).join(", ") + " mm: " +
      (names.get(value) || "air");
  }

  // What a person chose is told to the views.
  function tell() {
    document.dispatchEvent(new CustomEvent("mammotwin-place", { detail: cursor.map((index, axis) => position(axis, index)) }));
  }

  function move(axis, by) {
    cursor[axis] = clamp(cursor[axis] + by, 0, volume.size[axis] - 1);
    update();
    tell();
  }

  function pointAt(plane, event) {
    const box = plane.canvas.getBoundingClientRect();
    const part = (at, n) => clamp(Math.floor(at * n), 0, n - 1);
    cursor[plane.right] = part((event.clientX - box.left) / box.width, volume.size[plane.right]);
    const n = volume.size[plane.down], down = part((event.clientY - box.top) / box.height, n);
    cursor[plane.down] = plane.falls ? n - 1 - down : down;
    update();
    tell();
  }

  function listen(plane) {
    const canvas = plane.canvas, down = plane.falls ? -1 : 1;
    // A finger that swipes scrolls the page; one that taps, or a mouse that drags, moves the cross.
    canvas.addEventListener("pointerdown", event => {
      if (event.pointerType === "touch") return;
      canvas.setPointerCapture(event.pointerId);
      pointAt(plane, event);
    });
    canvas.addEventListener("pointermove", event => {
      if (event.pointerType !== "touch" && event.buttons & 1) pointAt(plane, event);
    });
    canvas.addEventListener("pointerup", event => { if (event.pointerType === "touch") pointAt(plane, event); });
    canvas.addEventListener("wheel", event => {
      if (document.activeElement !== canvas) return;  // the page scrolls until a plane is chosen
      event.preventDefault();
      move(plane.normal, Math.sign(event.deltaY));
    }, { passive: false });
    const keys = { ArrowLeft: [plane.right, -1], ArrowRight: [plane.right, 1], ArrowUp: [plane.down, -down],
                   ArrowDown: [plane.down, down], PageUp: [plane.normal, 1], PageDown: [plane.normal, -1] };
    canvas.addEventListener("keydown", event => {
      if (!keys[event.key]) return;
      event.preventDefault();
      move(keys[event.key][0], keys[event.key][1]);
    });
    plane.slider.addEventListener("input", () => { cursor[plane.normal] = Number(plane.slider.value); update(); tell(); });
  }

  function build(plane) {
    const figure = document.createElement("figure");
    const width = volume.size[plane.right] * volume.spacing[plane.right];
    const height = volume.size[plane.down] * volume.spacing[plane.down];
    figure.style.flexGrow = width;  // one scale in all three
    figure.innerHTML = "<canvas tabindex='0' role='img'></canvas><label><span></span> <input type='range' min='0'> <output></output></label>";
    plane.canvas = figure.querySelector("canvas");
    plane.canvas.style.aspectRatio = width + " / " + height;
    plane.canvas.setAttribute("aria-label", plane.name + " plane through the cross; arrow keys move the cross, page keys the plane");
    figure.querySelector("span").textContent = plane.name;
    plane.slider = figure.querySelector("input");
    plane.slider.max = volume.size[plane.normal] - 1;
    plane.output = figure.querySelector("output");
    plane.memory = document.createElement("canvas");
    plane.memory.width = volume.size[plane.right];
    plane.memory.height = volume.size[plane.down];
    listen(plane);
    document.getElementById("planes-row").append(figure);
  }

  function addPlaces() {
    for (const place of volume.places) {
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = place.name;
      button.addEventListener("click", () => { cursor = voxel(place.at); update(); tell(); });
      document.getElementById("planes-places").append(button);
    }
  }

  async function start() {
    labels = await mammotwin.inflate(volume.labels);
    if (volume.grey) grey = await mammotwin.inflate(volume.grey);
    else strength.value = 95;
    addPlaces();
    PLANES.forEach(build);
    root.hidden = false;
    document.querySelectorAll("details.stills").forEach(d => { d.open = false; });
    strength.addEventListener("input", update);
    window.addEventListener("resize", update);
    document.addEventListener("mammotwin-curve", event => {
      curve = event.detail;
      if (curve.length) cursor = voxel(curve[curve.length >> 1]);
      update();
    });
    update();
    root.dataset.ready = performance.now().toFixed(0);  // [ms] since the page was asked for
  }
  start();
})();
