// Turns the breast in three dimensions; the pictures below it stay where WebGL is missing.
(function () {
  "use strict";
  const root = document.getElementById("viewer");
  const scene = JSON.parse(document.getElementById("scene").textContent);
  const canvas = root.querySelector("canvas");
  let renderer;
  try {
    renderer = new THREE.WebGLRenderer({ canvas: canvas, antialias: true, alpha: true });
  } catch (error) {
    return;
  }
  root.hidden = false;
  document.documentElement.classList.add("has-viewer");

  const numbers = (text, Type) => new Type(Uint8Array.from(atob(text), c => c.charCodeAt(0)).buffer);
  const triangles = numbers(scene.triangles, Uint32Array);
  const unpacked = state => Object.assign({}, state, { points: numbers(state.points, Float32Array) });
  const states = scene.states.map(unpacked), views = scene.views.map(unpacked);
  const rest = states[states.length - 1];  // compression begins at the shape free of stress
  const mix = (a, b, t) => a + (b - a) * t;
  const mixed = (a, b, t) => a.map((value, i) => mix(value, b[i], t));

  const world = new THREE.Scene();
  world.add(new THREE.HemisphereLight(0xffffff, 0x99a0aa, 0.75));
  const lamp = new THREE.DirectionalLight(0xffffff, 0.55);
  world.add(lamp);

  const geometry = new THREE.BufferGeometry();
  geometry.setIndex(new THREE.BufferAttribute(triangles, 1));
  geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(states[0].points), 3));
  geometry.setAttribute("color", new THREE.BufferAttribute(numbers(scene.tissue, Float32Array), 3));
  const skin = side => new THREE.MeshPhongMaterial({
    vertexColors: THREE.VertexColors, transparent: true, opacity: 0.5, depthWrite: false, shininess: 12, side: side });
  const back = new THREE.Mesh(geometry, skin(THREE.BackSide));
  const front = new THREE.Mesh(geometry, skin(THREE.FrontSide));
  back.renderOrder = 0;
  front.renderOrder = 2;
  world.add(back, front);

  const sphere = (radius, colour) => {
    const mesh = new THREE.Mesh(new THREE.SphereBufferGeometry(radius, 24, 16), new THREE.MeshPhongMaterial({ color: colour }));
    mesh.renderOrder = 1;
    world.add(mesh);
    return mesh;
  };
  const marks = scene.marks.map(m => sphere(m.radius_mm, m.colour));

  const plate = () => {
    const material = new THREE.MeshPhongMaterial({ color: 0x6c7a89, transparent: true, opacity: 0.35, depthWrite: false, side: THREE.DoubleSide });
    const mesh = new THREE.Mesh(new THREE.PlaneBufferGeometry(1, 1), material);
    mesh.renderOrder = 3;
    world.add(mesh);
    return mesh;
  };
  const support = plate(), paddle = plate();
  const place = (mesh, corners) => {
    const p = mesh.geometry.attributes.position;
    [0, 1, 3, 2].forEach((corner, i) => p.setXYZ(i, corners[corner][0], corners[corner][1], corners[corner][2]));
    p.needsUpdate = true;
    mesh.geometry.computeVertexNormals();
    mesh.geometry.computeBoundingSphere();
  };

  const camera = new THREE.PerspectiveCamera(30, 1, 1, 5000);
  camera.up.set(0, 0, 1);
  const controls = new THREE.OrbitControls(camera, canvas);
  controls.enableKeys = false;
  // One finger scrolls the page; two turn and zoom the breast.
  controls.touches = { ONE: THREE.TOUCH.ROTATE, TWO: THREE.TOUCH.DOLLY_ROTATE };
  for (const type of ["touchstart", "touchmove"])
    canvas.parentElement.addEventListener(type, event => {
      if (event.target === canvas && event.touches.length < 2) event.stopPropagation();
    }, { capture: true });
  geometry.computeBoundingSphere();
  const centre = geometry.boundingSphere.center, radius = geometry.boundingSphere.radius;
  controls.target.copy(centre);
  camera.position.set(centre.x + scene.turn * 2 * radius, centre.y - 2.5 * radius, centre.z + 1.1 * radius);
  camera.lookAt(controls.target);

  const draw = () => {
    const width = canvas.clientWidth, height = canvas.clientHeight;
    renderer.setPixelRatio(window.devicePixelRatio || 1);
    renderer.setSize(width, height, false);
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    lamp.position.copy(camera.position);
    renderer.render(world, camera);
  };

  let chosen = views[0];
  const slider = document.getElementById("viewer-compression");
  const amount = document.getElementById("viewer-amount");
  const show = (points, marked) => {
    const p = geometry.attributes.position;
    for (let i = 0; i < p.array.length; ++i) p.array[i] = points(i);
    p.needsUpdate = true;
    geometry.computeVertexNormals();
    marks.forEach((mark, i) => mark.position.fromArray(marked(i)));
  };
  const showState = () => {
    slider.disabled = true;
    amount.textContent = "no plates";
    show(i => chosen.points[i], i => chosen.marks[i]);
  };
  const showView = () => {
    const t = slider.value / 100;
    slider.disabled = false;
    amount.textContent = slider.value + " %, plates " + mix(chosen.open_mm, chosen.thickness_mm, t).toFixed(0) + " mm apart";
    show(i => mix(rest.points[i], chosen.points[i], t), i => mixed(rest.marks[i], chosen.marks[i], t));
    const blend = (from, to) => to.map((corner, i) => mixed(from[i], corner, t));
    place(support, blend(chosen.support_open, chosen.support));
    place(paddle, blend(chosen.paddle_open, chosen.paddle));
  };
  const update = () => {
    support.visible = paddle.visible = Boolean(chosen.paddle);
    if (chosen.paddle) showView(); else showState();
    root.dataset.lesion = marks.length ? marks[0].position.toArray().map(x => x.toFixed(2)).join(" ") : "";
    draw();
  };

  const choice = (group, parent, text, checked, onChoice) => {
    const label = document.createElement("label"), button = document.createElement("input");
    button.type = "radio";
    button.name = group;
    button.checked = checked;
    button.addEventListener("change", onChoice);
    label.append(button, " " + text);
    document.getElementById(parent).append(label);
  };
  states.concat(views).forEach(state =>
    choice("viewer-view", "viewer-views", state.name, state === chosen, () => { chosen = state; update(); }));
  const paint = colours => {
    geometry.setAttribute("color", new THREE.BufferAttribute(numbers(colours, Float32Array), 3));
    const seeThrough = colours === scene.tissue;
    for (const material of [back.material, front.material]) {
      material.opacity = seeThrough ? 0.5 : 1;
      material.depthWrite = !seeThrough;
    }
    draw();
  };
  if (scene.fit_error) {
    document.getElementById("viewer-paint").hidden = false;
    choice("viewer-colour", "viewer-colours", "tissue", true, () => paint(scene.tissue));
    choice("viewer-colour", "viewer-colours", "fit error", false, () => paint(scene.fit_error));
  }
  slider.addEventListener("input", update);
  controls.addEventListener("change", draw);
  window.addEventListener("resize", draw);

  const turn = (sideways, upwards, zoom) => {
    const offset = camera.position.clone().sub(controls.target);
    const s = new THREE.Spherical().setFromVector3(new THREE.Vector3(offset.x, offset.z, -offset.y));
    s.theta += sideways;
    s.phi = Math.min(Math.max(s.phi + upwards, 0.05), Math.PI - 0.05);
    s.radius *= zoom;
    const v = new THREE.Vector3().setFromSpherical(s);
    camera.position.set(v.x, -v.z, v.y).add(controls.target);
    controls.update();
  };
  const keys = { ArrowLeft: [-0.1, 0, 1], ArrowRight: [0.1, 0, 1], ArrowUp: [0, -0.1, 1], ArrowDown: [0, 0.1, 1], "+": [0, 0, 0.9], "-": [0, 0, 1.1] };
  canvas.addEventListener("keydown", event => {
    if (!keys[event.key]) return;
    event.preventDefault();
    turn.apply(null, keys[event.key]);
  });
  update();
})();
