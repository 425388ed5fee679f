// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

namespace orbweave {

/// The stylesheet of report.html and scaling.html. Colours are variables, so that dark is a change
/// of some lines. Those that carry meaning are of Okabe and Ito (2002), k0 to k6 and the fills of
/// states; text in a state's colour is darkened, or lightened, until it reads.
inline constexpr char kReportStyle[] = R"css(
:root{color-scheme:light dark;--bg:#f7f6f3;--card:#fff;--ink:#1d2126;--soft:#5f6770;--line:#e3e1db;--accent:#0072b2;
--accent2:#9cc7e2;--good:#00694d;--warn:#8a5a00;--bad:#a84300;--fgood:#009e73;--fwarn:#e69f00;--fbad:#d55e00;--grid:#ebe9e4;
--k0:#0072b2;--k1:#e69f00;--k2:#009e73;--k3:#cc79a7;--k4:#56b4e9;--k5:#d55e00;--k6:#b8a800;--kn:#8a9199}
@media(prefers-color-scheme:dark){:root{--bg:#121519;--card:#1a1f25;--ink:#e8eaed;--soft:#a2abb5;--line:#2b323a;
--accent:#56b4e9;--accent2:#1f4f70;--good:#3fcf9f;--warn:#f0b540;--bad:#ff8a4a;--grid:#262c33;
--k6:#f0e442;--kn:#7b838c}}
*{box-sizing:border-box}
body{margin:0;background:var(--bg);color:var(--ink);font:15px/1.5 system-ui,-apple-system,"Segoe UI",Roboto,"Liberation Sans",sans-serif}
main{max-width:1120px;margin:0 auto;padding:36px 24px 60px}
header{display:flex;justify-content:space-between;align-items:baseline;flex-wrap:wrap;gap:4px 20px;margin-bottom:22px}
h1{font-size:27px;line-height:1.2;font-weight:650;letter-spacing:-.02em;margin:0;overflow-wrap:anywhere}
header p{margin:0;color:var(--soft)}
h2{font-size:16px;font-weight:650;margin:0 0 2px}
.sub{color:var(--soft);font-size:13px;margin:0 0 12px;overflow-wrap:anywhere}
td .sub{margin:0}
.map+.sub,.key+.sub{margin-top:16px}
section{background:var(--card);border:1px solid var(--line);border-radius:12px;padding:18px 20px;margin:0 0 16px;overflow-x:auto}
.verdict{border-left:6px solid var(--fgood)}
.verdict.doubtful{border-left-color:var(--fwarn)}
.verdict.bad{border-left-color:var(--fbad);color:inherit}
.verdict.good{color:inherit}
.verdict h2{font-size:19px;margin-bottom:4px}
.verdict .sub{margin:0}
.level{display:inline-block;width:1.15em;height:1.15em;margin-right:.45em;vertical-align:-.22em;fill:none;stroke:#fff;stroke-width:2;
stroke-linecap:round;stroke-linejoin:round}
.level circle{fill:var(--fgood);stroke:none}
.level .shape{fill:var(--fbad);stroke:none}
.level.doubtful{stroke:#1d2126}
.level.doubtful .shape{fill:var(--fwarn)}
.cards{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(210px,100%),1fr));gap:12px;margin-bottom:16px}
.card{background:var(--card);border:1px solid var(--line);border-radius:12px;padding:14px}
.card b{display:block;font-size:23px;line-height:1.2;font-weight:620;letter-spacing:-.02em;font-variant-numeric:tabular-nums}
.card b small{font-size:14px;font-weight:500;color:var(--soft)}
.card span{color:var(--soft);font-size:13px}
.pair{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(380px,100%),1fr));gap:0 16px}
svg{display:block;width:100%;height:auto}
svg text{fill:var(--soft);font-size:12px;font-variant-numeric:tabular-nums}
.k0{color:var(--k0)}.k1{color:var(--k1)}.k2{color:var(--k2)}.k3{color:var(--k3)}.k4{color:var(--k4)}.kn{color:var(--kn)}
.map{border-radius:8px;background:var(--bg)}
.path{fill:none;stroke:var(--soft);opacity:.35;stroke-width:2.5;stroke-linejoin:round}
.dot{fill:currentColor}
.dot.hollow{fill-opacity:.2;stroke:currentColor;stroke-width:1.5}
.dot.overlap{stroke:var(--ink);stroke-width:1.3}
.sym{fill:none;stroke-width:1.8;stroke-linejoin:round}
.loose{fill:var(--bg);stroke:currentColor}
.missing{stroke:var(--ink)}
.outlier,.dash{fill:none;stroke:var(--fbad);stroke-width:1.6}
.dash{stroke-dasharray:4 3;stroke-width:1.4}
.sigma{fill:var(--accent);fill-opacity:.13;stroke:var(--accent);stroke-opacity:.6}
.sigma.cut{stroke-dasharray:5 4}
.seam{fill:var(--card);stroke:var(--ink)}
.seam.fits{stroke:var(--fgood)}
.seam.doubtful{fill:var(--fwarn)}
.seam.bad,.seam.unused{fill:var(--fbad)}
.seam.unknown{stroke-dasharray:3 2}
.scale{fill:none;stroke:var(--soft);stroke-width:1.5}
.north{fill:var(--soft)}
.grid{stroke:var(--grid);fill:none}
.bar{fill:var(--accent)}
.bar[class*=" k"]{fill:currentColor}
.bar:hover{opacity:.7}
.mark{stroke:var(--ink);stroke-width:1.5;stroke-dasharray:4 3}
svg .marktext{fill:var(--ink);font-weight:600}
.only-narrow{display:none}
table{border-collapse:collapse;width:100%;font-size:14px;font-variant-numeric:tabular-nums}
th,td{text-align:right;padding:5px 10px;border-bottom:1px solid var(--line);vertical-align:top}
th{color:var(--soft);font-weight:500;font-size:12.5px;white-space:nowrap;vertical-align:bottom}
.slim{width:1%}
tr:last-child td{border-bottom:0}
th:first-child,td:first-child,.text{text-align:left}
td.text{overflow-wrap:anywhere}
.checks td{white-space:nowrap}
.checks td.sentence{white-space:normal}
.wide{width:42%;text-align:left}
.wall,.cpu{height:7px;border-radius:4px;min-width:2px;margin:2px 0}
.wall,.key .wall{background:var(--accent)}
.cpu,.key .cpu{background:var(--accent2)}
.key{display:flex;flex-wrap:wrap;gap:4px 18px;color:var(--soft);font-size:13px;margin:10px 0 0}
.key i{display:inline-block;width:11px;height:11px;border-radius:50%;margin-right:6px;vertical-align:-1px;background:currentColor}
.key i.wall,.key i.cpu{border-radius:3px}
.key i.hollow{background:none;border:2px solid currentColor}
.icon{display:inline-block;width:16px;height:16px;margin-right:5px;vertical-align:-3px}
.good{color:var(--good)}.bad{color:var(--bad)}.warn{color:var(--warn)}
p.warn{margin:0 0 4px}
ul{margin:0;padding-left:20px}
li{overflow-wrap:anywhere}
figure{margin:0}
figure img,img.shot{display:block;width:100%;border-radius:8px}
figcaption{color:var(--soft);font-size:13px;margin:4px 0 12px;overflow-wrap:anywhere}
img.shot{background:var(--bg)}
details ul{margin-top:4px}
summary{cursor:pointer;font-weight:650}
pre{font:12.5px/1.5 ui-monospace,"SF Mono",Menlo,Consolas,monospace;white-space:pre-wrap;overflow-wrap:anywhere;margin:12px 0 0;color:var(--soft)}
footer{color:var(--soft);font-size:13px;margin-top:22px}
@media(max-width:640px){
main{padding:20px 12px 40px}
section{padding:14px 13px}
h1{font-size:22px}
.cards{grid-template-columns:1fr 1fr;gap:8px}
.card{padding:10px 12px}
.card b{font-size:19px}
.minor,.only-wide{display:none}
.only-narrow{display:block}
th,td{padding:5px 5px}
th{white-space:normal}
.chart text{font-size:17px}
.map text{font-size:26px}
.north+text{transform:translateY(13px)}
.map .dot{r:9px}
.map.many .dot{r:6px}
.map .sym{transform:scale(1.9)}
.map .path{stroke-width:5}
.map .dash{stroke-width:3.5;stroke-dasharray:10 7}
.checks thead{display:none}
.checks tr{display:grid;grid-template-columns:auto 1fr auto auto;gap:0 8px;padding:6px 0;border-bottom:1px solid var(--line)}
.checks tr:last-child{border-bottom:0}
.checks td{border:0;padding:0;min-width:0}
.checks td.text+td.text:not(.sentence){white-space:normal}
.checks td.sentence{grid-column:1/-1;color:var(--soft);font-size:13px}
}
@media print{body{background:#fff}section,.card{break-inside:avoid}}
)css";

}  // namespace orbweave
