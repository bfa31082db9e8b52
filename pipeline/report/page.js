const mammotwin = {};  // what the page's scripts share
(function () {
  "use strict";
  // Bytes that zlib packed, in base64.
  mammotwin.inflate = async text => {
    const bytes = Uint8Array.from(atob(text), c => c.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  };

  // Opens before printing what a page on paper must show, and closes it again.
  const folded = () => document.querySelectorAll("details.on-paper");
  window.addEventListener("beforeprint", () => folded().forEach(d => { d.dataset.was = d.open; d.open = true; }));
  window.addEventListener("afterprint", () => folded().forEach(d => { d.open = d.dataset.was === "true"; }));

  // Marks on the views, shown or not.
  const marks = document.getElementById("marks");
  if (!marks) return;
  marks.hidden = false;
  marks.addEventListener("change", event => {
    const box = event.target, shown = document.getElementById("lesions").classList;
    if (box.value === "full-width") shown.toggle(box.value, box.checked);
    else shown.toggle("without-" + box.value, !box.checked);
  });
})();
