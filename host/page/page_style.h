#pragma once
/// The style sheet of all pages: readable on a phone and in the dark, without anything from outside.

namespace triad {

inline constexpr char page_style[] = R"css(
:root { color-scheme: light dark; --ink: #1b1f24; --soft: #57606a; --page: #ffffff; --card: #f5f6f8; --line: #d5d9de;
  --good: #00684b; --bad: #a83a00; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e4e7ea; --soft: #a3abb4; --page: #14171b; --card: #1d2127; --line: #363c44; --good: #3fd0a3; --bad: #ff9a5c; } }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 1rem; max-width: 76rem; background: var(--page); color: var(--ink);
  font: 16px/1.5 system-ui, -apple-system, "Segoe UI", "Noto Sans", sans-serif; overflow-wrap: break-word; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: .5rem 0; }
h2 { font-size: 1.3rem; margin: 2.5rem 0 .5rem; padding-top: 1rem; border-top: 1px solid var(--line); }
h3 { font-size: 1.05rem; margin: 1.5rem 0 .5rem; }
p { margin: .5rem 0; max-width: 48rem; }
.soft { color: var(--soft); }
code { font: .9em ui-monospace, "DejaVu Sans Mono", monospace; background: var(--card); padding: .1em .3em; border-radius: .2em; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: .1rem 1rem; margin: .5rem 0; }
dt { color: var(--soft); } dd { margin: 0; }
.score { font-size: 1.25rem; }
.score b { font-size: 2rem; } .score span { font-size: 1rem; }
table { overflow-wrap: anywhere; border-collapse: collapse; width: 100%; margin: .75rem 0; font-size: .92rem; font-variant-numeric: tabular-nums; }
th, td { text-align: left; padding: .4rem .6rem; border-bottom: 1px solid var(--line); vertical-align: top; }
th { color: var(--soft); font-weight: 600; }
tbody th { color: var(--ink); }
td.n { white-space: nowrap; } @media (max-width: 66rem) { td.n { white-space: normal; overflow-wrap: normal; } } thead th { overflow-wrap: normal; }
tbody th, tbody th + td { min-width: 7.5rem; }
td small { display: block; color: var(--soft); white-space: nowrap; }
.good { color: var(--good); } .bad { color: var(--bad); font-weight: 600; }
.pictures { display: grid; grid-template-columns: 1fr; gap: 1rem; margin: 1rem 0; }
@media (min-width: 34rem) { .pictures { grid-template-columns: 1fr 1fr; } }
@media (min-width: 64rem) { .pictures { grid-template-columns: repeat(4, 1fr); } .pictures .first { grid-column: 2; } }
.plots { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(28rem, 100%), 1fr)); gap: 1rem; margin: 1rem 0; }
figure { margin: 0; background: var(--card); border: 1px solid var(--line); border-radius: .4rem; padding: .5rem; }
figure img { display: block; width: 100%; height: auto; border-radius: .2rem; }
figcaption { padding: .4rem .1rem 0; font-size: .9rem; }
.scale { display: flex; flex-wrap: wrap; align-items: center; gap: 0 .5rem; font-size: .8rem; color: var(--soft); margin-top: .3rem; justify-content: space-between; }
.scale i { order: -1; flex: 0 0 100%; height: .7rem; border-radius: .2rem; border: 1px solid var(--line); }
.wide { max-width: 46rem; }
details { margin: 1rem 0; } summary { cursor: pointer; font-weight: 600; }
@media (max-width: 50rem) {
  thead { position: absolute; left: -9999px; }
  table, tbody, tr, td, tbody th { display: block; width: 100%; }
  tr { border: 1px solid var(--line); border-radius: .4rem; margin: .75rem 0; padding: .3rem 0; background: var(--card); }
  td, tbody th { border: 0; padding: .15rem .6rem; display: grid; grid-template-columns: 8.5rem 1fr; column-gap: .5rem; }
  td small, td .v { grid-column: 2; } td small { white-space: normal; }
  td::before, tbody th::before { content: attr(data-label); color: var(--soft); font-weight: 400; grid-column: 1; }
  td.n { white-space: normal; }
}
)css";

}  // namespace triad
