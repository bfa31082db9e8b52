#pragma once

namespace mammotwin {

/// The look of the cohort's page on wide and narrow screens and on paper. Status is told by words
/// and signs, never by colour alone; text has at least 4.5:1 contrast (WCAG 2.1, 1.4.3).
inline constexpr char kPageStyle[] = R"css(
:root { color-scheme: light; --ink: #1d2329; --soft: #56616c; --line: #d5dae0; --bar: #7d9cc0;
  --band: #c9d6e6; --bad: #a3201d; --look: #7a5200; --good: #1d6b3a; }
body { font: 16px/1.5 system-ui, "DejaVu Sans", sans-serif; color: var(--ink); background: #fff;
  max-width: 76rem; margin: 0 auto; padding: 1rem; }
h1 { margin: 0 0 .2rem; font-size: 1.7rem; }
h2 { margin: 2.2rem 0 .6rem; font-size: 1.25rem; border-bottom: 2px solid var(--line); }
h3 { margin: 1.4rem 0 .4rem; font-size: 1.05rem; }
p.note { color: var(--soft); margin: .2rem 0; }
ul.counts { display: flex; flex-wrap: wrap; gap: .6rem; list-style: none; padding: 0; }
ul.counts li { border: 1px solid var(--line); border-radius: .4rem; padding: .3rem .8rem; }
ul.counts b { font-size: 1.3rem; }
.refused, .not_converged, .interrupted, .not_run { color: var(--bad); }
.look { color: var(--look); }
.ok { color: var(--good); }
.status { font-weight: 600; white-space: nowrap; }
div.wide { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-size: .93rem; }
caption { text-align: left; color: var(--soft); padding-bottom: .3rem; }
th, td { text-align: left; vertical-align: top; padding: .3rem .8rem .3rem 0;
  border-bottom: 1px solid var(--line); }
code { font: .88em "DejaVu Sans Mono", monospace; overflow-wrap: anywhere; }
div.figures { display: grid; grid-template-columns: repeat(auto-fill, minmax(17rem, 1fr)); gap: 1rem; }
figure { margin: 0; border: 1px solid var(--line); border-radius: .4rem; padding: .5rem .7rem;
  break-inside: avoid; }
figcaption { font-size: .93rem; }
figure p { font-size: .85rem; margin: .2rem 0 0; }
figure svg { width: 100%; display: block; }
svg .bar { fill: var(--bar); }
svg .band { fill: var(--band); }
svg .median { fill: var(--ink); }
svg .out { fill: #fff; stroke: var(--bad); stroke-width: 1.5; }
svg text { font: 11px "DejaVu Sans", sans-serif; fill: var(--soft); }
a { color: #124f9c; }
a:focus-visible { outline: 3px solid #124f9c; outline-offset: 2px; }
@media (max-width: 40rem) {
  thead { position: absolute; left: -100vw; }
  tr { display: block; padding: .5rem 0; border-bottom: 1px solid var(--line); }
  tbody th, td { display: block; padding: .1rem 0; border: 0; }
}
@media print {
  body { max-width: none; padding: 0; font-size: 10pt; }
  div.wide { overflow: visible; }
  div.figures { grid-template-columns: repeat(3, 1fr); }
  h2, h3 { break-after: avoid; }
  tr { break-inside: avoid; }
}
)css";

}  // namespace mammotwin
