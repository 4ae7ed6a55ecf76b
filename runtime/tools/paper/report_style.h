#pragma once
// The style sheet of the report, for light and dark screens, and for paper.

namespace sgm::cli {

/// Style sheet of the report. The series of a chart use the classes s0 to s5. The colours of these classes also differ
/// in lightness. Variables such as --ink depend on the reader's preference for light or dark.
inline constexpr const char* kReportStyle = R"css(
:root {
  color-scheme: light dark;
  --paper: #ffffff; --ink: #1c2126; --soft: #59636e; --edge: #d5dbe1; --panel: #f5f7f9; --warn: #fff6e0; --warn-edge: #d9a521;
  --s0: #1f6fb2; --s1: #d1651a; --s2: #2b8a5a; --s3: #8a4fb0; --s4: #a3313f; --s5: #6b6f14;
}
@media (prefers-color-scheme: dark) {
  :root {
    --paper: #14181c; --ink: #e4e8ec; --soft: #9aa5b0; --edge: #343c45; --panel: #1d2329; --warn: #2f2815; --warn-edge: #b98c1c;
    --s0: #63a9e8; --s1: #f09a5b; --s2: #5cc592; --s3: #c090e6; --s4: #ea7c88; --s5: #c0c455;
  }
}
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 1.5rem 1rem 4rem; max-width: 64rem; background: var(--paper); color: var(--ink);
  font: 16px/1.55 system-ui, "DejaVu Sans", sans-serif; }
h1 { font-size: 1.9rem; line-height: 1.2; margin: 1rem 0 .5rem; }
h2 { font-size: 1.35rem; margin: 0 0 .75rem; }
h3 { font-size: 1rem; margin: 1.25rem 0 .35rem; }
a { color: var(--s0); }
nav ul { columns: 2; padding-left: 1.2rem; }
section { border-top: 2px solid var(--edge); margin-top: 2.5rem; padding-top: 1.5rem; }
blockquote { margin: .5rem 0; padding: .1rem 1rem; border-left: 4px solid var(--edge); color: var(--soft); }
blockquote p { margin: .35rem 0; }
.contradiction { background: var(--warn); border-left: 4px solid var(--warn-edge); margin: .75rem 0; padding: .5rem 1rem; }
.contradiction p { margin: .25rem 0; }
pre { background: var(--panel); border: 1px solid var(--edge); border-radius: 4px; padding: .6rem .8rem; margin: .35rem 0;
  font-size: .82rem; line-height: 1.5; white-space: pre; overflow-x: auto; }
code { font-family: ui-monospace, "DejaVu Sans Mono", monospace; font-size: .92em; }
details > summary { cursor: pointer; color: var(--soft); }
dl { display: grid; grid-template-columns: max-content 1fr; gap: .15rem 1rem; font-size: .92rem; }
dt { color: var(--soft); }
dd { margin: 0; }
.row { display: grid; grid-template-columns: repeat(auto-fit, minmax(15rem, 1fr)); gap: 1rem; align-items: start; margin: 1rem 0; }
figure { margin: 0 0 .5rem; break-inside: avoid; }
figure img { display: block; width: 100%; height: auto; border-radius: 4px; }
figcaption { color: var(--soft); font-size: .88rem; margin-top: .35rem; }
.table { overflow-x: auto; margin: 1rem 0; }
table { border-collapse: collapse; font-size: .88rem; font-variant-numeric: tabular-nums; }
caption { text-align: left; color: var(--soft); padding-bottom: .4rem; }
th, td { padding: .3rem .7rem; border-bottom: 1px solid var(--edge); text-align: right; vertical-align: top; }
th { font-weight: 600; }
thead th { border-bottom-width: 2px; vertical-align: bottom; }
th:first-child, .words td, .words th { text-align: left; }
svg { display: block; width: 100%; height: auto; }
svg text { font: 12px system-ui, "DejaVu Sans", sans-serif; fill: var(--ink); }
svg .axis { fill: var(--soft); }
svg .in { fill: var(--paper); }
svg .grid { stroke: var(--edge); stroke-width: 1; }
svg .base, svg .tick { stroke: var(--soft); stroke-width: 1; }
svg .line { fill: none; stroke: var(--c); stroke-width: 2; }
svg .law { fill: none; stroke: var(--c); stroke-width: 1.5; stroke-dasharray: 5 4; }
svg .steps { fill: var(--c); fill-opacity: .16; stroke: var(--c); stroke-width: 1.5; }
svg .bar { fill: var(--c); }
svg .mark { fill: var(--c); stroke: var(--paper); stroke-width: 1; }
svg .s0 { --c: var(--s0); } svg .s1 { --c: var(--s1); } svg .s2 { --c: var(--s2); }
svg .s3 { --c: var(--s3); } svg .s4 { --c: var(--s4); } svg .s5 { --c: var(--s5); }
@media print {
  body { max-width: none; font-size: 10pt; padding: 0; }
  section { break-inside: auto; }
  pre { white-space: pre-wrap; overflow-wrap: anywhere; }
  pre, .table, svg { break-inside: avoid; }
}
)css";

}  // namespace sgm::cli
