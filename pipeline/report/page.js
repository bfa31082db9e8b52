// Opens before printing what a page on paper must show, and closes it again.
(function () {
  "use strict";
  const stills = () => document.querySelectorAll("details.stills");
  window.addEventListener("beforeprint", () => stills().forEach(d => { d.dataset.was = d.open; d.open = true; }));
  window.addEventListener("afterprint", () => stills().forEach(d => { d.open = d.dataset.was === "true"; }));
})();
