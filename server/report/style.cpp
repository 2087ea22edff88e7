#include "report/style.hpp"

namespace camdir::report {

const char* const style = R"css(
:root{color-scheme:light dark;--paper:#fff;--ink:#1b1f24;--soft:#5d6673;--rule:#d9dee5;--panel:#f5f7f9;
--c0:#1667d9;--c1:#c2600a;--c2:#7b8490;--best:#137a3a;--shade:#8b95a33d;--band:#2f9e5426}
@media(prefers-color-scheme:dark){:root{--paper:#14171b;--ink:#e6e9ed;--soft:#9aa4b1;--rule:#323943;--panel:#1d2228;
--c0:#6cabff;--c1:#ff9d4d;--c2:#8d97a4;--best:#5fd28b;--shade:#8b95a340;--band:#2f9e542b}}
@media print{:root{color-scheme:light;--paper:#fff;--ink:#000;--soft:#444;--rule:#bbb;--panel:#fff;
--c0:#1667d9;--c1:#c2600a;--c2:#7b8490;--best:#137a3a}nav{display:none!important}
figure,article,.tiles{break-inside:avoid}}
*{box-sizing:border-box}
html{scroll-padding-top:3.2rem}
body{margin:0;background:var(--paper);color:var(--ink);font:15px/1.5 system-ui,sans-serif;overflow-wrap:anywhere}
main,header{max-width:1240px;margin:0 auto;padding:0 16px}
h1{font-size:1.7rem;line-height:1.2;margin:1.4rem 0 .6rem}
h2{font-size:1.25rem;margin:2.4rem 0 .6rem;padding-top:.6rem;border-top:1px solid var(--rule)}
h3{font-size:1rem;margin:1.2rem 0 .3rem}
p{margin:.4rem 0;max-width:75ch}
small,figcaption{color:var(--soft);font-size:.83rem}
code{font:.83rem/1.4 ui-monospace,monospace}
pre{margin:.3rem 0;padding:.5rem .7rem;background:var(--panel);border-radius:6px;white-space:pre-wrap}
figure{margin:0}
svg,img{display:block;width:100%}
svg.definitions{position:absolute;width:0;height:0}
dl{display:grid;grid-template-columns:max-content 1fr;gap:.1rem .9rem;margin:.6rem 0}
dt{color:var(--soft)}dd{margin:0}
nav{position:sticky;top:0;z-index:2;background:var(--paper);border-bottom:1px solid var(--rule)}
nav div{max-width:1240px;margin:0 auto;padding:.4rem 16px;display:flex;gap:.35rem;overflow-x:auto;align-items:center}
nav button{font:inherit;font-size:.85rem;color:inherit;background:var(--panel);border:1px solid var(--rule);
border-radius:99px;padding:.1rem .7rem;cursor:pointer;white-space:nowrap}
nav button[aria-pressed=true]{background:var(--c0);border-color:var(--c0);color:var(--paper)}
nav span{color:var(--soft);font-size:.85rem;white-space:nowrap}
.tiles{display:grid;grid-template-columns:repeat(8,1fr);gap:.5rem;margin:1rem 0}
@media(max-width:1150px){.tiles{grid-template-columns:repeat(4,1fr)}}
@media(max-width:640px){.tiles{grid-template-columns:repeat(2,1fr)}}
.tiles div{background:var(--panel);border-radius:8px;padding:.5rem .7rem}
.tiles b{display:block;font-size:1.3rem;line-height:1.25;font-variant-numeric:tabular-nums}
.tiles b small{font-weight:400}
.table{overflow-x:auto}
table{border-collapse:collapse;font-variant-numeric:tabular-nums}
th,td{padding:.16rem .8rem;text-align:right;border-bottom:1px solid var(--rule);white-space:nowrap}
th:first-child{text-align:left;padding-left:0;font-weight:400}
thead th{color:var(--soft);font-weight:600}
td:last-child{text-align:left;white-space:normal;min-width:18rem;max-width:60ch;color:var(--soft);font-size:.83rem}
td.best{color:var(--best);font-weight:600}
.strip{display:grid;grid-template-columns:repeat(7,1fr);gap:4px}
@media(max-width:900px){.strip{grid-template-columns:repeat(4,1fr)}}
@media(max-width:520px){.strip{grid-template-columns:repeat(2,1fr)}}
.strip svg{border-radius:3px}
@media(hover:hover) and (min-width:901px){.strip svg:hover{position:relative;z-index:3;transform:scale(2.4)}
.strip figure:first-child svg{transform-origin:left}.strip figure:last-child svg{transform-origin:right}}
.middle{fill:none;stroke:#fff9;stroke-dasharray:3 4}
.ring{fill:none;stroke:#fff;stroke-width:1.5;filter:drop-shadow(0 0 1px #000) drop-shadow(0 0 1px #000)}
.fault-hidden{--c:#e03131}.fault-clearance{--c:#9c36b5}.fault-frame{--c:#0ca678}.fault-side{--c:#f08c00}
.fault-distance{--c:#3b82f6}.uncounted{--c:var(--shade)}.band{--c:var(--band)}.cut{--c:var(--soft)}
.camera-0{--c:var(--c0)}.camera-1{--c:var(--c1)}.camera-2{--c:var(--c2)}
.player-0{--c:#e61a26}.player-1{--c:#0073d9}.player-2{--c:#e08700}.player-3{--c:#1a9933}
.player-4{--c:#9926b3}.player-5{--c:#00929e}.player-6{--c:#d94d99}.player-7{--c:#734d26}
.fixed{--c:#868e96}
.key{display:inline-block;width:.75em;height:.75em;border-radius:2px;margin:0 .35em 0 .1em;background:var(--c)}
.key.cut{width:2px;border-radius:0}
.legend{max-width:none;display:flex;flex-wrap:wrap;gap:.1rem .9rem}
.timeline{margin:.6rem 0;min-width:760px}
.timeline text{font-size:11px;fill:var(--soft)}.timeline .lane{fill:var(--panel)}.timeline .shot{fill:var(--c)}
.timeline .moment{fill:var(--soft);opacity:.35}
.timeline circle.seen{fill:var(--best);stroke:#fff}.timeline circle.missed{fill:#e03131;stroke:#fff}
.timeline circle.unjudged{fill:var(--soft);stroke:#fff}.timeline path.unjudged{stroke:var(--soft)}
.timeline path{fill:none;stroke-width:2.5;filter:drop-shadow(0 0 1px #fff) drop-shadow(0 0 1px #fff)}
.timeline path.seen{stroke:var(--best)}.timeline path.missed{stroke:#e03131}
.strip.cut{grid-template-columns:repeat(3,1fr);max-width:960px;width:auto;height:auto}
.plan{background:#fff;border-radius:6px}
.plan path{fill:none;stroke:var(--c)}
.plan .eye{stroke-width:4;opacity:.4}.plan .view{stroke-width:1.6;opacity:.9}
.all .plan path{opacity:.3}.all .plan .eye{opacity:.2}
.plan circle{fill:var(--c);fill-opacity:.75;stroke:#fff;stroke-width:1}
.player{position:relative;border-top:1px solid var(--rule)}
summary{cursor:pointer}
.player summary{display:grid;grid-template-columns:5.5rem 6.7rem 1fr;align-items:center;cursor:pointer;padding:.3rem 0;gap:0 .3rem}
.player .good{color:var(--soft);font-variant-numeric:tabular-nums}
.ribbon{height:14px;background:var(--panel);border-radius:3px}
path.uncounted,path.band,path[class^=fault]{fill:var(--c)}
.chart{display:grid;grid-template-columns:8.3rem 4.5rem 1fr;margin:.25rem 0}
.chart .ticks{display:flex;flex-direction:column;justify-content:space-between;text-align:right;padding-right:.4rem;
color:var(--soft);font-size:.72rem;line-height:1;font-variant-numeric:tabular-nums}
.chart small{display:block}
.chart .rows{grid-column:1/3;display:flex;flex-direction:column;justify-content:space-around;font-size:.72rem;line-height:1.1}
.plot{height:86px;background:var(--panel);border-radius:3px}
.plot .line{fill:none;stroke:var(--c);stroke-width:1.1;vector-effect:non-scaling-stroke}
.plot .line.camera-1{opacity:.55}
path.cut{fill:none;stroke:var(--c);stroke-width:1;stroke-dasharray:2 2;vector-effect:non-scaling-stroke}
.times{display:flex;justify-content:space-between;margin-left:12.8rem;color:var(--soft);font-size:.72rem}
.cursor{position:absolute;top:2.1rem;bottom:0;width:1px;background:var(--ink);pointer-events:none;font-size:.72rem}
.cursor span{position:absolute;left:3px;bottom:0;background:var(--paper);white-space:nowrap}
.cursor.back span{left:auto;right:3px}
.distributions{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,460px),1fr));gap:1rem 1.5rem}
.distributions path{fill:none;stroke:var(--c);stroke-width:2}
.distributions .grid{stroke:var(--rule);stroke-width:1}
.distributions text{fill:var(--soft);font-size:11px}
.off{display:none}
@media(max-width:640px){th,td{padding:.16rem .4rem}table{font-size:.85rem}td:last-child{min-width:40rem}
.chart{grid-template-columns:2.6rem 1fr}.chart figcaption{grid-column:1/3}.chart small{display:inline}.chart .rows+.plot{grid-column:1/3}
.times{margin-left:2.6rem}.player summary{grid-template-columns:1fr 1fr}.ribbon{grid-column:1/3}}
)css";

const char* const script = R"js(
const nav = document.querySelector('nav');
nav.hidden = false;
function choose(player) {
  document.body.classList.toggle('all', player === '');
  for (const button of nav.querySelectorAll('button'))
    button.setAttribute('aria-pressed', button.value === player);
  for (const part of document.querySelectorAll('[data-player]')) {
    part.classList.toggle('off', player !== '' && part.dataset.player !== player);
    if (part.tagName === 'DETAILS' && player !== '') part.open = true;
  }
}
for (const button of nav.querySelectorAll('button')) button.onclick = () => choose(button.value);
choose('');
addEventListener('beforeprint', () => { for (const part of document.querySelectorAll('details')) part.open = true; });
const duration = Number(document.querySelector('main').dataset.duration);
for (const part of document.querySelectorAll('.player')) {
  const cursor = document.createElement('div');
  const label = cursor.appendChild(document.createElement('span'));
  cursor.className = 'cursor';
  part.addEventListener('pointermove', event => {
    const plot = event.target.closest('.plot');
    if (!plot) return cursor.remove();
    const box = plot.getBoundingClientRect();
    const share = (event.clientX - box.left) / box.width;
    label.textContent = (share * duration).toFixed(2) + ' s';
    cursor.classList.toggle('back', share > 0.8);
    cursor.style.left = event.clientX - part.getBoundingClientRect().left + 'px';
    part.append(cursor);
  });
  part.addEventListener('pointerleave', () => cursor.remove());
}
)js";

}  // namespace camdir::report
