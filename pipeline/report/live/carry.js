// Marks carried between the views and the MRI on the grids that came with the page: a click on a
// view draws the curve on which that tissue lies in the MRI and in the other view; a place in the
// MRI is shown in the views.
(function () {
  "use strict";
  const element = document.getElementById("carry");
  if (!element || !mammotwin.panes || typeof DecompressionStream === "undefined") return;
  const NOWHERE = -32768;
  const status = document.getElementById("carry-status");

  // A grid's value at x by trilinear interpolation; null where a corner has none or x is outside the breast.
  const carried = (grid, x) => {
    const at = x.map((value, axis) => (value - grid.origin[axis]) / grid.spacing[axis]);
    const first = at.map(Math.floor), share = at.map((value, axis) => value - first[axis]);
    const [nx, ny, nz] = grid.size;
    if (first[0] < 0 || first[1] < 0 || first[2] < 0 || first[0] + 1 >= nx || first[1] + 1 >= ny || first[2] + 1 >= nz) return null;
    const sum = [0, 0, 0];
    let inside = 0;
    for (let corner = 0; corner < 8; ++corner) {
      const step = [corner & 1, corner >> 1 & 1, corner >> 2];
      const node = first[0] + step[0] + nx * (first[1] + step[1] + ny * (first[2] + step[2]));
      if (grid.values[3 * node] === NOWHERE) return null;
      const weight = step.reduce((product, one, axis) => product * (one ? share[axis] : 1 - share[axis]), 1);
      for (let axis = 0; axis < 3; ++axis) sum[axis] += weight * grid.values[3 * node + axis];
      inside += weight * grid.inside[node];
    }
    return inside < 0.5 ? null : sum.map((value, axis) => grid.middle[axis] + grid.step * value);
  };

  const project = (view, [x, y, z]) => {
    const enlarged = view.source_distance_mm / (view.source_distance_mm - view.support_gap_mm - z);
    return [enlarged * x, enlarged * y];
  };
  mammotwin.project = project;

  const words = ([u, v]) => "u " + u.toFixed(1).replace("-", "−") + ", v " + v.toFixed(1).replace("-", "−") + " mm";
  const cross = (uv) => (context, pane) => {
    const [x, y] = pane.at(uv);
    context.beginPath();
    for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
      context.moveTo(x + 4 * dx, y + 4 * dy);
      context.lineTo(x + 12 * dx, y + 12 * dy);
    }
    mammotwin.edged(context, mammotwin.views.mark_colour, 2);
  };
  const line = points => (context, pane) => {
    mammotwin.path(context, pane, points);
    mammotwin.edged(context, mammotwin.views.mark_colour, 2);
  };

  async function start() {
    const grids = JSON.parse(element.textContent);
    for (const way of [grids.prone_from, grids.from_prone])
      for (const grid of Object.values(way)) {
        grid.values = new Int16Array((await mammotwin.inflate(grid.values)).buffer);
        grid.inside = await mammotwin.inflate(grid.inside);
      }

    // Where tissue seen at (u, v) lies prone, from the support up.
    const curve = (view, [u, v]) => {
      const points = [];
      for (let height = view.lowest_mm; height <= view.highest_mm; height += 1) {
        const share = (view.source_distance_mm - view.support_gap_mm - height) / view.source_distance_mm;
        const prone = carried(grids.prone_from[view.view], [u * share, v * share, height]);
        if (prone) points.push(prone);
      }
      return points;
    };
    const seen = (view, prone) => {
      const x = carried(grids.from_prone[view.view], prone);
      return x && project(view, x);
    };
    mammotwin.curve = (name, uv) => curve(mammotwin.panes.get(name).view, uv);
    mammotwin.seen = (name, prone) => seen(mammotwin.panes.get(name).view, prone);

    const clear = () => {
      mammotwin.panes.forEach(pane => pane.show("mark", null));
      document.dispatchEvent(new CustomEvent("mammotwin-curve", { detail: [] }));
      status.textContent = "";
    };
    document.getElementById("carry-clear").addEventListener("click", clear);

    for (const pane of mammotwin.panes.values())
      pane.listeners.push(uv => {
        const points = curve(pane.view, uv);
        clear();
        pane.show("mark", cross(uv));
        const said = "Mark on " + pane.view.title + " at " + words(uv);
        if (!points.length) {
          status.textContent = said + ": no tissue of the model there.";
          return;
        }
        for (const other of mammotwin.panes.values())
          if (other.view.view === pane.view.view) other.show("mark", cross(uv));
          else other.show("mark", line(points.map(p => seen(other.view, p)).filter(Boolean)));
        document.dispatchEvent(new CustomEvent("mammotwin-curve", { detail: points }));
        status.textContent = said + ": the lines show where that tissue can lie in the other view and, below, in the MRI.";
      });
    document.addEventListener("mammotwin-place", event => {
      const places = [];
      for (const pane of mammotwin.panes.values()) {
        const uv = seen(pane.view, event.detail);
        pane.show("mark", uv && cross(uv));
        places.push(pane.view.title + (uv ? " " + words(uv) : ": not in the model"));
      }
      status.textContent = "Place in the MRI: " + places.join("; ") + ".";
    });
    document.getElementById("carry-note").hidden = false;
    element.dataset.ready = "yes";
  }
  start();
})();
