// How a report looks: on a light and a dark screen, and on paper.
#pragma once

namespace laboratory {

constexpr const char* REPORT_STYLE = R"css(
:root { color-scheme: light dark; --ink: #1c1c1c; --paper: #fff; --soft: #595959; --rule: #d4d4d4;
  --shade: #f5f5f3; --accent: #00588a; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e6e6e6; --paper: #161616; --soft: #a6a6a6; --rule: #3d3d3d; --shade: #222;
    --accent: #7cc4f2; }
  .plot svg { filter: invert(0.914) hue-rotate(180deg); }
}
* { box-sizing: border-box; }
body { margin: 0; background: var(--paper); color: var(--ink);
  font: 16px/1.5 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; }
main { max-width: 80rem; margin: 0 auto; padding: 2rem 1.25rem 3rem; }
h1 { font-size: 1.9rem; line-height: 1.2; margin: 0 0 .5rem; }
h2 { font-size: 1.25rem; margin: 2.5rem 0 .75rem; padding-bottom: .25rem;
  border-bottom: 1px solid var(--rule); }
h3 { font-size: 1.05rem; margin: 1.5rem 0 .5rem; }
summary { cursor: pointer; color: var(--accent); margin: .5rem 0; }
.question { font-size: 1.15rem; color: var(--soft); margin: 0 0 1.5rem; max-width: 45rem; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: .25rem 1.25rem; margin: 0; }
dt { color: var(--soft); }
dd { margin: 0; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: .9rem; font-variant-numeric: tabular-nums; }
th, td { padding: .25rem .7rem; text-align: left; vertical-align: top; }
thead th { border-bottom: 2px solid var(--ink); vertical-align: bottom; }
tbody th { font-weight: normal; }
tbody tr { border-bottom: 1px solid var(--rule); }
tbody tr.group { border-top: 2px solid var(--soft); }
.number { text-align: right; white-space: nowrap; }
.model td:last-child { color: var(--soft); }
.key { font-family: ui-monospace, "DejaVu Sans Mono", monospace; font-size: .85rem; }
.calibrated, .assumed { font-weight: 600; color: var(--accent); }
figure { margin: 0; break-inside: avoid; }
.plot { max-width: 50rem; }
figcaption { color: var(--soft); font-size: .9rem; margin-top: .4rem; }
.plots { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 34rem), 1fr));
  gap: 1.5rem; }
.plot svg { display: block; width: 100%; height: auto; border: 1px solid #e6e6e6; }
.network svg { display: block; max-width: 100%; height: auto; background: #fff; }
.network { margin-bottom: 1.5rem; }
.images { display: flex; flex-wrap: wrap; gap: 1.5rem; }
.images img { display: block; max-width: 100%; height: auto; }
.pixelated { image-rendering: pixelated; }
pre { background: var(--shade); border: 1px solid var(--rule); padding: .8rem 1rem; margin: .5rem 0;
  overflow-x: auto; font: .85rem/1.45 ui-monospace, "DejaVu Sans Mono", monospace; }
a { color: var(--accent); }
@media print {
  :root { --ink: #000; --paper: #fff; --soft: #444; --rule: #bbb; --shade: #fff; --accent: #000; }
  .plot svg { filter: none; }
  body { font-size: 10pt; }
  main { max-width: none; padding: 0; }
  .plots { grid-template-columns: 1fr 1fr; gap: .75rem; }
  .wide, pre { overflow: visible; }
  pre { white-space: pre-wrap; }
  h2 { break-after: avoid; }
  tr { break-inside: avoid; }
  thead { display: table-header-group; }
  .download { display: none; }
}
)css";

}  // namespace laboratory
