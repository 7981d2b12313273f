#include "report/style.h"

namespace rpf::report {

// What may be wider than the page (tables, code, plots) scrolls inside its own box. Plots stay black on white: their
// colors are chosen for that.
const char* const style = R"(
:root { color-scheme: light dark; --text: #1d1d20; --page: #ffffff; --line: #d3d3d8; --quiet: #5c5c63; --box: #f4f4f6 }
@media (prefers-color-scheme: dark) {
  :root { --text: #e7e7ea; --page: #17171a; --line: #3b3b41; --quiet: #a9a9b1; --box: #232327 }
}
* { box-sizing: border-box }
body { margin: 0 auto; padding: 1rem; max-width: 76rem; font: 1rem/1.5 system-ui, sans-serif; color: var(--text);
  background: var(--page); overflow-wrap: anywhere }
h1 { font-size: 1.6rem; line-height: 1.2 }
h2 { font-size: 1.2rem; margin-top: 2.2rem }
p { max-width: 46rem }
a { color: inherit }
figure { margin: 0 }
figcaption { color: var(--quiet); font-size: .875rem }
.wide, pre { overflow-x: auto; max-width: 100%; margin: 1rem 0 }
pre { padding: .7rem; background: var(--box); font-size: .8125rem; overflow-wrap: normal }
table { border-collapse: collapse; font-size: .875rem; font-variant-numeric: tabular-nums; overflow-wrap: normal }
th, td { padding: .3rem .7rem .3rem 0; border-bottom: 1px solid var(--line); text-align: right; vertical-align: top;
  white-space: nowrap }
th { vertical-align: bottom; white-space: normal }
.text { text-align: left; white-space: normal; min-width: 8rem; max-width: 32rem }
.grid { display: grid; gap: 1rem; margin: 1rem 0;
  grid-template-columns: repeat(auto-fill, minmax(min(100%, var(--least)), 1fr)) }
.grid img { display: block; max-width: 100%; height: auto }
.legend { display: flex; flex-wrap: wrap; gap: .2rem .8rem; align-items: center; font-size: .8125rem }
.legend i { display: inline-block; width: .8rem; height: .8rem; margin-right: .35rem; vertical-align: -.1rem }
.legend .bar { flex: 1 1 4rem; margin: 0 }
.plot { max-width: 46rem; margin: 1rem 0 }
.plot svg { display: block; width: 100%; min-width: 22rem; height: auto; background: #ffffff }
)";

}  // namespace rpf::report
