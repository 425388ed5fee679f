// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

namespace orbweave {

/// The stylesheet of report.html. Colours are variables, so that dark is a change of twelve lines.
inline constexpr char kReportStyle[] = R"css(
:root{color-scheme:light dark;--bg:#f7f6f3;--card:#fff;--ink:#1d2126;--soft:#5f6770;--line:#e3e1db;--accent:#1f7a8c;
--accent2:#9ccbd4;--warn:#b3541e;--bad:#c0262d;--good:#2c7a4b;--grid:#ebe9e4}
@media(prefers-color-scheme:dark){:root{--bg:#121519;--card:#1a1f25;--ink:#e8eaed;--soft:#98a1ab;--line:#2b323a;
--accent:#5fb8c9;--accent2:#2d5963;--warn:#e59b63;--bad:#ff6b70;--good:#6cc593;--grid:#262c33}}
*{box-sizing:border-box}
body{margin:0;background:var(--bg);color:var(--ink);font:15px/1.5 system-ui,-apple-system,"Segoe UI",Roboto,"Liberation Sans",sans-serif}
main{max-width:1120px;margin:0 auto;padding:36px 24px 60px}
header{display:flex;justify-content:space-between;align-items:baseline;flex-wrap:wrap;gap:4px 20px;margin-bottom:22px}
h1{font-size:27px;line-height:1.2;font-weight:650;letter-spacing:-.02em;margin:0;overflow-wrap:anywhere}
header p{margin:0;color:var(--soft)}
h2{font-size:16px;font-weight:650;margin:0 0 2px}
.sub{color:var(--soft);font-size:13px;margin:0 0 12px}
section{background:var(--card);border:1px solid var(--line);border-radius:12px;padding:18px 20px;margin:0 0 16px;overflow-x:auto}
.cards{display:grid;grid-template-columns:repeat(auto-fit,minmax(210px,1fr));gap:12px;margin-bottom:16px}
.card{background:var(--card);border:1px solid var(--line);border-radius:12px;padding:14px}
.card b{display:block;font-size:23px;line-height:1.2;font-weight:620;letter-spacing:-.02em;font-variant-numeric:tabular-nums}
.card b small{font-size:14px;font-weight:500;color:var(--soft)}
.card span{color:var(--soft);font-size:13px}
.pair{display:grid;grid-template-columns:repeat(auto-fit,minmax(380px,1fr));gap:16px}
svg{display:block;width:100%;height:auto}
svg text{fill:var(--soft);font-size:12px;font-variant-numeric:tabular-nums}
.map{border-radius:8px;background:var(--bg)}
.path{fill:none;stroke:var(--soft);opacity:.35;stroke-width:2.5;stroke-linejoin:round}
.overlap{stroke:var(--ink);stroke-width:1.3}
.outlier{fill:none;stroke:var(--bad);stroke-width:1.4;stroke-dasharray:4 3}
.sigma{fill:var(--accent);fill-opacity:.13;stroke:var(--accent);stroke-opacity:.6}
.sigma.cut{stroke-dasharray:5 4}
.seam{fill:var(--card);stroke:var(--ink);stroke-width:1.8}
.seam.good{stroke:var(--good)}
.seam.doubtful{stroke:var(--warn);fill:var(--warn)}
.seam.bad{stroke:var(--bad);fill:var(--bad)}
.seam.unused{stroke:var(--bad);fill:var(--bad)}
.scale{fill:none;stroke:var(--soft);stroke-width:1.5}
.north{fill:var(--soft)}
.grid{stroke:var(--grid);fill:none}
.bar{fill:var(--accent)}
.bar:hover{opacity:.7}
.mark{stroke:var(--warn);stroke-width:1.5;stroke-dasharray:4 3}
svg .marktext{fill:var(--warn);font-weight:600}
table{border-collapse:collapse;width:100%;font-size:14px;font-variant-numeric:tabular-nums}
th,td{text-align:right;padding:5px 10px;border-bottom:1px solid var(--line);vertical-align:top}
th{color:var(--soft);font-weight:500;font-size:12.5px;white-space:nowrap}
tr:last-child td{border-bottom:0}
th:first-child,td:first-child,.text{text-align:left}
td.text{overflow-wrap:anywhere}
.wide{width:42%;text-align:left}
.wall,.cpu{height:7px;border-radius:4px;min-width:2px;margin:2px 0}
.wall,.key .wall{background:var(--accent)}
.cpu,.key .cpu{background:var(--accent2)}
.key{display:flex;flex-wrap:wrap;gap:4px 18px;color:var(--soft);font-size:13px;margin:10px 0 0}
.key i{display:inline-block;width:11px;height:11px;border-radius:50%;margin-right:6px;vertical-align:-1px;background:var(--soft)}
.key i.wall,.key i.cpu{border-radius:3px}
.key i.ring{background:none;border:2px solid var(--ink)}
.key i.hollow{background:none;border:2px solid var(--soft)}
.key i.sigma{width:17px;border-radius:50%;background:var(--accent2);border:1px solid var(--accent)}
.key i.diamond{border-radius:0;transform:rotate(45deg) scale(.8);background:var(--card);border:2px solid var(--good)}
.key i.diamond.warn{background:var(--warn);border-color:var(--warn)}
.key i.diamond.bad{background:var(--bad);border-color:var(--bad)}
.key i.dash{border-radius:0;height:0;border-top:2px dashed var(--bad);background:none;vertical-align:4px}
.good{color:var(--good)}.bad{color:var(--bad)}.warn{color:var(--warn)}
ul{margin:0;padding-left:20px}
li{overflow-wrap:anywhere}
summary{cursor:pointer;font-weight:650}
pre{font:12.5px/1.5 ui-monospace,"SF Mono",Menlo,Consolas,monospace;overflow-x:auto;margin:12px 0 0;color:var(--soft)}
footer{color:var(--soft);font-size:13px;margin-top:22px}
@media print{body{background:#fff}section,.card{break-inside:avoid}}
)css";

}  // namespace orbweave
