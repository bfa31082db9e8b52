// Sliders: lesions, their outlines, search ellipses and the skin's outline follow from the reduced
// model that came with the page, x(s) = x + sum s_i a_i + s_i^2 b_i in each view's frame, s from -1 to 1 over a slider.
(function () {
  "use strict";
  const root = document.getElementById("what-if");
  if (!root || !mammotwin.panes) return;
  const panes = [...mammotwin.panes.values()].filter(pane => pane.view.what_if);
  if (!panes.length) return;
  // registration/search/view_state.h: mechanical numbers, then turn, depth and lateral
  const STATES = panes[0].view.what_if.ellipse.sd.length, MECHANICAL = STATES - 3;
  const TURN = MECHANICAL, DEPTH = MECHANICAL + 1, LATERAL = MECHANICAL + 2;
  const NINETY = Math.sqrt(8 * (Math.pow(1 - 0.9, -2 / 10) - 1));  // registration/search/search_ellipse.h
  const WORDS = {
    thickness_mm: ["Thickness", (by, view) => (view.thickness_mm + by).toFixed(1) + " mm"],
    roll_deg: ["Angle", (by, view) => (view.angle_deg + by).toFixed(1).replace("-", "−") + "°"],
    ln_stiffness_ratio: ["Gland to fat, stiffness", by => "× " + Math.exp(by).toFixed(2)],
    clearance_mm: ["Plates' edge", by => (by < 0 ? "−" : "+") + Math.abs(by).toFixed(1) + " mm"],
  };
  const SHARED = "ln_stiffness_ratio";

  const POINT = 3 * (1 + MECHANICAL + 2 * 4);  // numbers of a point: place, slopes of the ellipse, a and b of four sliders

  const shareOf = number => number.by / number.range;
  const isMoved = model => model.numbers.some(number => number.by !== 0);

  const placeOf = (model, point) => {
    const from = point * POINT, x = [0, 1, 2].map(axis => model.values[from + axis]);
    for (const number of model.numbers) {
      const s = shareOf(number), a = from + 3 * (1 + MECHANICAL + 2 * number.mode);
      for (let axis = 0; axis < 3; ++axis) x[axis] += s * model.values[a + axis] + s * s * model.values[a + 3 + axis];
    }
    return x;
  };

  // Slopes on the detector a standard deviation: those of search_ellipse.cpp.
  const slopes = (view, point, x) => {
    const model = view.what_if, sd = model.ellipse.sd, here = mammotwin.project(view, x);
    const to = moved => { const there = mammotwin.project(view, moved); return [there[0] - here[0], there[1] - here[1]]; };
    const J = [];
    for (let i = 0; i < MECHANICAL; ++i) {
      const from = point * POINT + 3 * (1 + i);
      J.push(to(x.map((value, axis) => value + model.values[from + axis])));
    }
    const t = sd[TURN] * Math.PI / 180;
    J.push(to([Math.cos(t) * x[0] - Math.sin(t) * x[1], Math.sin(t) * x[0] + Math.cos(t) * x[1], x[2]]));
    J.push(to([x[0] + sd[DEPTH], x[1], x[2]]), to([x[0], x[1] + sd[LATERAL], x[2]]));
    return J;
  };
  const ellipseOf = (view, { point, unexplained_mm2 }, x) => {
    const J = slopes(view, point, x), { covariance } = view.what_if.ellipse;
    const S = [unexplained_mm2, 0, unexplained_mm2];  // uu, uv, vv
    for (let i = 0; i < STATES; ++i)
      for (let j = 0; j < STATES; ++j) {
        const c = covariance[i * STATES + j];
        if (c === 0) continue;
        S[0] += J[i][0] * c * J[j][0];
        S[1] += J[i][0] * c * J[j][1];
        S[2] += J[i][1] * c * J[j][1];
      }
    const middle = (S[0] + S[2]) / 2, half = Math.hypot((S[0] - S[2]) / 2, S[1]);
    return { major: NINETY * Math.sqrt(middle + half), minor: NINETY * Math.sqrt(middle - half),
             angle: Math.atan2(2 * S[1], S[0] - S[2]) / 2 };
  };
  // Of a lesion by its number: where the sliders put it, and its ellipse.
  mammotwin.whatIf = (name, lesion) => {
    const view = mammotwin.panes.get(name).view, model = view.what_if;
    const x = placeOf(model, model.lesions[lesion].point);
    return { uv: mammotwin.project(view, x), ellipse: ellipseOf(view, model.lesions[lesion], x) };
  };

  // An outline's pieces, given by the numbers of their ends, one after the other.
  const loopsOf = ends => {
    const next = new Map();
    for (let n = 0; n < ends.length; n += 2)
      for (const [a, b] of [[ends[n], ends[n + 1]], [ends[n + 1], ends[n]]]) next.set(a, [...(next.get(a) || []), b]);
    const loops = [], seen = new Set();
    for (const first of next.keys()) {
      if (seen.has(first)) continue;
      const loop = [];
      for (let at = first; at !== undefined; at = next.get(at).find(point => !seen.has(point))) {
        loop.push(at);
        seen.add(at);
      }
      loops.push([...loop, first]);
    }
    return loops;
  };

  const rim = ({ major, minor, angle }, [u, v]) => Array.from({ length: 73 }, (_, n) => {
    const t = n * Math.PI / 36, a = major * Math.cos(t), b = minor * Math.sin(t);
    return [u + Math.cos(angle) * a - Math.sin(angle) * b, v + Math.sin(angle) * a + Math.cos(angle) * b];
  });

  function drawSkin(context, pane) {
    const model = pane.view.what_if, line = [];
    for (const ray of model.skin) {
      if (ray.far === null) continue;
      const far = model.numbers.reduce((sum, number) => {
        const s = shareOf(number);
        return sum + s * ray.slopes[number.mode] + s * s * ray.curvatures[number.mode];
      }, ray.far);
      line.push(ray.direction.map(d => far * d));
    }
    mammotwin.path(context, pane, line);
    context.setLineDash([6, 4]);
    mammotwin.edged(context, "#fff", 1);
    context.setLineDash([]);
  }

  function drawNipple(context, pane) {
    const model = pane.view.what_if;
    if (model.nipple === undefined) return;
    const [x, y] = pane.at(mammotwin.project(pane.view, placeOf(model, model.nipple)));
    context.beginPath();
    context.moveTo(x, y - 6);
    context.lineTo(x - 6, y + 5);
    context.lineTo(x + 6, y + 5);
    context.closePath();
    mammotwin.edged(context, mammotwin.views.nipple_colour, 2);
  }

  function drawLesions(context, pane) {
    const { view } = pane, model = view.what_if, hidden = document.getElementById("lesions").classList;
    const colour = mammotwin.views.lesion_colour;
    for (const lesion of model.lesions) {
      const x = placeOf(model, lesion.point), uv = mammotwin.project(view, x), ellipse = ellipseOf(view, lesion, x);
      if (!hidden.contains("without-ellipses")) {
        mammotwin.path(context, pane, rim(ellipse, uv));
        mammotwin.edged(context, colour, 2);
      }
      if (!hidden.contains("without-lesions")) {
        context.beginPath();
        for (const loop of lesion.loops)
          loop.forEach((point, n) => {
            const at = pane.at(mammotwin.project(view, placeOf(model, point)));
            n ? context.lineTo(...at) : context.moveTo(...at);
          });
        mammotwin.edged(context, colour, 1.2);
      }
      if (hidden.contains("without-labels")) continue;
      const [left, top] = pane.at(uv);
      context.font = "600 14px system-ui, sans-serif";
      context.lineWidth = 4;
      context.strokeStyle = "#000";
      context.fillStyle = "#fff";
      context.strokeText(lesion.id, left + 8, top - 8);
      context.fillText(lesion.id, left + 8, top - 8);
    }
  }

  const drawMoved = (context, pane) => {
    drawSkin(context, pane);
    if (!document.getElementById("lesions").classList.contains("without-lesions")) drawNipple(context, pane);
    drawLesions(context, pane);
  };

  // "L1 in CC: 34 mm behind the nipple, 33 mm medial."
  const placeWords = pane => {
    const { view } = pane, model = view.what_if;
    if (model.nipple === undefined) return [];
    const nipple = mammotwin.project(view, placeOf(model, model.nipple));
    return model.lesions.map(lesion => {
      const uv = mammotwin.project(view, placeOf(model, lesion.point)), aside = uv[1] - nipple[1];
      const side = view.cranio_caudal ? (aside < 0 ? "medial" : "lateral") : (aside < 0 ? "below" : "above");
      return lesion.id + " in " + view.title + ": " + (nipple[0] - uv[0]).toFixed(0).replace("-", "−") + " mm behind the nipple, " + Math.abs(aside).toFixed(0) + " mm " + side + ".";
    });
  };

  let frame = 0;
  const update = () => {
    if (frame) return;
    frame = requestAnimationFrame(() => {
      frame = 0;
      for (const pane of panes) {
        const moved = isMoved(pane.view.what_if);
        pane.box.classList.toggle("moved", moved);
        pane.show("what-if", moved ? drawMoved : null);
      }
      root.dataset.frames = Number(root.dataset.frames || 0) + 1;
      say();
    });
  };
  const say = () => {
    const moved = panes.filter(pane => isMoved(pane.view.what_if));
    document.getElementById("what-if-places").textContent = moved.flatMap(placeWords).join(" ");
  };

  // One row of sliders; a choice says which views they move.
  let chosen = panes;
  const rows = document.getElementById("what-if-rows"), sliders = [];
  const refresh = () => {
    for (const { name, input, output } of sliders) {
      const view = chosen[0].view, number = view.what_if.numbers.find(n => n.name === name);
      input.value = number.by;
      output.textContent = chosen.map(pane => WORDS[name][1](pane.view.what_if.numbers.find(n => n.name === name).by, pane.view))
        .filter((text, n, all) => all.indexOf(text) === n).join(" | ");
      input.setAttribute("aria-valuetext", output.textContent);
    }
  };
  const set = (name, by) => {
    for (const pane of name === SHARED ? panes : chosen) pane.view.what_if.numbers.find(n => n.name === name).by = by;
    refresh();
    update();
  };
  for (const pane of panes) {
    const model = pane.view.what_if;
    model.values = new Float32Array(Uint8Array.from(atob(model.points), c => c.charCodeAt(0)).buffer);
    for (const number of model.numbers) number.by = 0;
    for (const lesion of model.lesions) lesion.loops = loopsOf(lesion.outline);
  }
  for (const { name, range } of panes[0].view.what_if.numbers) {
    const label = document.createElement("label"), input = document.createElement("input"), output = document.createElement("output");
    Object.assign(input, { type: "range", min: -range, max: range, step: range / 40 });
    input.name = name;
    input.addEventListener("input", () => set(name, Math.abs(input.value) < range / 80 ? 0 : Number(input.value)));
    label.append(WORDS[name][0], input, output);
    rows.append(label);
    sliders.push({ name, input, output });
  }
  const group = document.getElementById("what-if-views");
  if (panes.length > 1)
    for (const [text, which] of [["both views", panes], ...panes.map(pane => [pane.view.title, [pane]])]) {
      const label = document.createElement("label"), radio = document.createElement("input");
      radio.type = "radio";
      radio.name = "what-if-view";
      radio.checked = which === panes;
      radio.addEventListener("change", () => { chosen = which; refresh(); });
      label.append(radio, " " + text);
      group.append(label);
    }
  document.getElementById("what-if-back").addEventListener("click", () => {
    for (const pane of panes) for (const number of pane.view.what_if.numbers) number.by = 0;
    refresh();
    update();
  });
  document.getElementById("marks").addEventListener("change", update);
  root.hidden = false;
  refresh();
})();
