// Turnable scenes on plain canvas: no WebGL and no library. The data come from bezier/pictures/scene.py.
(() => {
"use strict";
const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
const LIGHT = [-0.33, -0.62, 0.71];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = a => { const n = Math.hypot(...a) || 1; return [a[0] / n, a[1] / n, a[2] / n]; };
const triples = flat => { const out = []; for (let i = 0; i < flat.length; i += 3) out.push([flat[i], flat[i + 1], flat[i + 2]]); return out; };
const rgb = hex => [1, 3, 5].map(i => parseInt(hex.slice(i, i + 2), 16));
const digits = (x, n = 4) => String(Number(x.toPrecision(n)));

function prepared(body) {
  const points = triples(body.v), faces = triples(body.f), centre = [0, 1, 2].map(i => points.reduce((s, p) => s + p[i], 0) / points.length);
  const normals = body.n ? triples(body.n) : faces.map(f => {
    const n = unit(cross(minus(points[f[1]], points[f[0]]), minus(points[f[2]], points[f[0]])));
    return dot(n, minus(points[f[0]], centre)) < 0 ? n.map(c => -c) : n;
  });
  const creases = [], known = new Map();
  if (!body.edges) faces.forEach((f, k) => [[0, 1], [1, 2], [2, 0]].forEach(([a, b]) => {
    const key = Math.min(f[a], f[b]) + "-" + Math.max(f[a], f[b]);
    if (!known.has(key)) known.set(key, k);
    else if (dot(normals[k], normals[known.get(key)]) < 0.8) creases.push([[points[f[a]], points[f[b]]], [normals[k], normals[known.get(key)]]]);
  }));
  return { ...body, points, faces, normals, creases, lines: (body.edges || []).map(triples), colours: body.colours.map(rgb) };
}

function show(box, data) {
  const canvas = box.querySelector("canvas"), pen = canvas.getContext && canvas.getContext("2d");
  if (!pen) return;
  const layer = document.createElement("canvas"), spare = document.createElement("canvas");
  const bodies = data.bodies.map(prepared), curves = data.curves.map(c => ({ ...c, points: triples(c.v), net: triples(c.polygon) }));
  const clouds = data.clouds.map(c => ({ ...c, points: triples(c.v) }));
  const frames = data.motion && { ...data.motion, points: triples(data.motion.p) };
  const arm = data.arm;
  const count = arm ? arm.frames.length : frames ? frames.points.length : 0;
  const slider = box.querySelector(".play input"), button = box.querySelector(".play button"), told = box.querySelector(".play output");
  let [tilt, turn] = data.view.map(d => d * Math.PI / 180), zoom = 1, clock = 0, playing = count > 0 && !still, last = null, drag = null, stale = true, seen = true;
  let right, up, toward, scale, middle, ratio, style;
  const hull = outline();

  function outline() {
    const found = [...bodies.flatMap(b => data.reach ? [] : b.points), ...data.marks.map(m => m[1])];
    if (data.reach) for (let a = 0; a < 2 * Math.PI; a += 0.26) for (let h = data.floor ? 0 : -1.57; h <= 1.58; h += 0.262)
      found.push([Math.cos(a) * Math.cos(h), Math.sin(a) * Math.cos(h), Math.sin(h)].map(c => c * data.reach));
    for (const c of curves) found.push(...c.points);
    if (arm) for (const f of arm.frames) found.push(...f.p);
    return found;
  }
  function look() {
    const [c, s, ct, st] = [Math.cos(turn), Math.sin(turn), Math.cos(tilt), Math.sin(tilt)];
    right = [-s, c, 0]; up = [-st * c, -st * s, ct]; toward = [ct * c, ct * s, st];
    ratio = devicePixelRatio || 1;
    const w = Math.max(1, Math.round(canvas.clientWidth * ratio)), h = Math.max(1, Math.round(canvas.clientHeight * ratio));
    for (const one of [canvas, layer, spare]) if (one.width !== w || one.height !== h) { one.width = w; one.height = h; }
    const xs = hull.map(p => dot(p, right)), ys = hull.map(p => dot(p, up)), pad = 30 * ratio;
    const [x0, x1, y0, y1] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
    scale = zoom * Math.min((w - 2 * pad) / (x1 - x0 || 1), (h - 2 * pad) / (y1 - y0 || 1));
    const own = data.reach && curves.length ? curves.flatMap(c => c.points) : hull, share = Math.max(0, 1 - 1 / zoom);
    const centre = axis => (Math.min(...own.map(p => dot(p, axis))) + Math.max(...own.map(p => dot(p, axis)))) / 2;
    middle = [(x0 + x1) / 2 * (1 - share) + centre(right) * share, (y0 + y1) / 2 * (1 - share) + centre(up) * share];
    const read = getComputedStyle(document.documentElement);
    style = name => read.getPropertyValue("--" + name).trim();
  }
  const place = p => [canvas.width / 2 + scale * (dot(p, right) - middle[0]), canvas.height / 2 - scale * (dot(p, up) - middle[1])];
  function trace(on, points) { on.beginPath(); points.forEach((p, i) => i ? on.lineTo(...place(p)) : on.moveTo(...place(p))); }
  function line(on, points, colour, width, alpha = 1, dash = []) {
    on.save(); on.globalAlpha = alpha; on.strokeStyle = colour; on.lineWidth = width * ratio; on.lineCap = on.lineJoin = "round";
    on.setLineDash(dash.map(d => d * ratio)); trace(on, points); on.stroke(); on.restore();
  }
  function spot(on, point, colour, size, hollow) {
    on.save(); on.beginPath(); on.arc(...place(point), size * ratio, 0, 7); on.fillStyle = hollow ? style("paper") : colour; on.fill();
    on.strokeStyle = hollow ? colour : style("paper"); on.lineWidth = 1.4 * ratio; on.stroke(); on.restore();
  }
  function workspace(on) {
    if (!data.reach) return;
    const r = data.reach, low = data.floor ? 0 : -Math.PI / 2, soft = style("pale");
    const at = (h, a) => [Math.cos(h) * Math.cos(a) * r, Math.cos(h) * Math.sin(a) * r, Math.sin(h) * r];
    const steps = (a, b, n) => Array.from({ length: n + 1 }, (_, i) => a + (b - a) * i / n);
    if (data.floor) {
      on.save(); trace(on, steps(0, 2 * Math.PI, 72).map(a => at(0, a))); on.globalAlpha = 0.10; on.fillStyle = style("floor"); on.fill(); on.restore();
      line(on, steps(0, 2 * Math.PI, 72).map(a => at(0, a)), style("floor"), 1.2, 0.9);
    }
    for (const h of data.floor ? [0.52, 1.05] : [-1.05, -0.52, 0, 0.52, 1.05]) line(on, steps(0, 2 * Math.PI, 72).map(a => at(h, a)), soft, 0.8, 0.28);
    for (let k = 0; k < 12; k++) line(on, steps(low, Math.PI / 2, 30).map(h => at(h, k * Math.PI / 6)), soft, 0.8, 0.28);
    const rim = steps(0, 2 * Math.PI, 144).map(a => [0, 1, 2].map(i => r * (Math.cos(a) * right[i] + Math.sin(a) * up[i])));
    for (let i = 0; i < 144; i++) if (!data.floor || rim[i][2] + rim[i + 1][2] >= 0) line(on, [rim[i], rim[i + 1]], soft, 1.2, 0.8);
  }
  function axes(on) {
    const corner = [38 * ratio, canvas.height - 38 * ratio], long = 20 * ratio;
    on.save(); on.font = `${11 * ratio}px system-ui, sans-serif`; on.textAlign = "center"; on.textBaseline = "middle"; on.lineWidth = 1.3 * ratio;
    on.strokeStyle = on.fillStyle = style("soft");
    ["x", "y", "z"].forEach((name, i) => {
      const arrow = [right[i] * long, -up[i] * long];
      on.beginPath(); on.moveTo(...corner); on.lineTo(corner[0] + arrow[0], corner[1] + arrow[1]); on.stroke();
      if (Math.hypot(...arrow) > 7 * ratio) on.fillText(name, corner[0] + arrow[0] * 1.4, corner[1] + arrow[1] * 1.4);
    });
    on.restore();
  }
  const front = body => body.faces.map((f, k) => k).filter(k => dot(body.normals[k], toward) > 0);
  function solid(on, body) {
    const to = spare.getContext("2d");
    to.clearRect(0, 0, spare.width, spare.height); to.lineWidth = ratio; to.lineJoin = "round";
    const light = unit([0, 1, 2].map(i => 0.5 * LIGHT[i] + 0.6 * toward[i] + 0.5 * up[i]));
    for (const k of front(body)) {
      const shade = 0.66 + 0.34 * Math.max(0, dot(body.normals[k], light)), c = body.colours[body.c ? body.c[k] : 0];
      to.fillStyle = to.strokeStyle = `rgb(${c.map(v => Math.round(v * shade))})`;
      trace(to, body.faces[k].map(i => body.points[i])); to.closePath(); to.fill(); to.stroke();
    }
    on.save(); on.globalAlpha = body.alpha; on.drawImage(spare, 0, 0); on.restore();
    const ink = style("ink");
    for (const [ends, sides] of body.creases) if (sides.some(n => dot(n, toward) > 0)) line(on, ends, ink, 0.9, 0.55);
    for (const crease of body.lines) line(on, crease, ink, 1, body.alpha < 1 ? 0.5 : 0.25);
  }
  // Which pieces of a curve lie before all bodies, and so are drawn over them again.
  function before(points) {
    const cover = bodies.map(b => front(b).map(k => ({ flat: b.faces[k].map(i => place(b.points[i])), at: dot(b.points[b.faces[k][0]], b.normals[k]), normal: b.normals[k] })));
    return points.slice(1).map((p, i) => {
      const m = [0, 1, 2].map(j => (p[j] + points[i][j]) / 2), q = place(m);
      return !cover.some(faces => faces.some(f => inside(q, f.flat) && dot(m, f.normal) < f.at - 1e-9));
    });
  }
  function inside(q, t) {
    let sign = 0;
    for (let i = 0; i < 3; i++) {
      const a = t[i], b = t[(i + 1) % 3], s = Math.sign((b[0] - a[0]) * (q[1] - a[1]) - (b[1] - a[1]) * (q[0] - a[0]));
      if (s && sign && s !== sign) return false;
      sign = sign || s;
    }
    return sign !== 0;
  }
  function names(on) {
    on.save(); on.textBaseline = "middle"; on.textAlign = "left"; on.lineJoin = "round";
    const taken = data.marks.map(m => { const [x, y] = place(m[1]), s = 5 * ratio; return [x - s, y - s, x + s, y + s]; });
    const busy = curves.flatMap(c => c.points.filter((_, i) => i % 3 === 0).map(place));
    // The arm moves over the names: they stand where it comes least.
    if (arm) for (let k = 0; k <= 12; k++) {
      const p = arm.frames[Math.round(k * (count - 1) / 12)].p;
      p.slice(1).forEach((b, i) => { for (let s = 0; s <= 1; s += 1 / 16) busy.push(place(p[i].map((a, j) => a + s * (b[j] - a)))); });
    }
    const hit = (a, b) => Math.max(0, Math.min(a[2], b[2]) - Math.max(a[0], b[0])) * Math.max(0, Math.min(a[3], b[3]) - Math.max(a[1], b[1]));
    for (const [name, point, main] of [...data.marks].sort((a, b) => b[2] - a[2])) {
      on.font = `${main ? 600 : 400} ${(main ? 13 : 12) * ratio}px system-ui, sans-serif`;
      const w = on.measureText(name).width, h = 15 * ratio, [x, y] = place(point);
      let best = null;
      for (const far of [9, 18, 30]) for (let k = 0; k < 12; k++) {
        const a = -Math.PI / 2 + k * Math.PI / 6, cx = x + Math.cos(a) * (far * ratio + w / 2 * Math.abs(Math.cos(a))), cy = y + Math.sin(a) * (far * ratio + 3 * ratio);
        const r = [cx - w / 2 - 2, cy - h / 2, cx + w / 2 + 2, cy + h / 2], area = (r[2] - r[0]) * h;
        const out = area - hit(r, [2, 2, canvas.width - 2, canvas.height - 2]);
        const cost = taken.reduce((s, t) => s + hit(r, t), 0) * 4 + out * 20 + busy.filter(b => b[0] > r[0] && b[0] < r[2] && b[1] > r[1] && b[1] < r[3]).length * area * 0.2 + far * area * 0.004;
        if (!best || cost < best.cost) best = { cost, r, cx, cy };
      }
      taken.push(best.r);
      on.strokeStyle = style("paper"); on.lineWidth = 3.5 * ratio; on.fillStyle = style(main ? "ink" : "soft");
      on.strokeText(name, best.cx - w / 2, best.cy); on.fillText(name, best.cx - w / 2, best.cy);
    }
    on.restore();
  }
  function background() {
    const on = layer.getContext("2d");
    on.clearRect(0, 0, layer.width, layer.height);
    workspace(on); axes(on);
    for (const c of clouds) for (const p of c.points) { on.globalAlpha = 0.45; on.fillStyle = c.colour; on.beginPath(); on.arc(...place(p), 2.2 * ratio, 0, 7); on.fill(); on.globalAlpha = 1; }
    const paint = (c, from, to) => line(on, c.points.slice(from, to + 1), style(c.tone) || c.colour, 3.6);
    for (const c of curves) { line(on, c.net, style(c.tone) || c.colour, 1.1, 0.75, [5, 4]); paint(c, 0, c.points.length - 1); }
    const depth = b => b.points.reduce((s, p) => s + dot(p, toward), 0) / b.points.length;
    for (const b of [...bodies].sort((a, b) => depth(a) - depth(b))) solid(on, b);
    if (bodies.length) for (const c of curves) before(c.points).forEach((free, i) => { if (free) paint(c, i, i + 1); });
    for (const c of curves) c.net.slice(1, -1).forEach(p => spot(on, p, style(c.tone) || c.colour, 3, true));
    for (const [, p, main] of data.marks) if (main) spot(on, p, style("ink"), 4);
    names(on);
  }
  function draw(index) {
    if (stale) { look(); background(); stale = false; }
    pen.clearRect(0, 0, canvas.width, canvas.height); pen.drawImage(layer, 0, 0);
    if (arm) {
      const f = arm.frames[index];
      line(pen, f.p, style("ink"), 6, 0.75);
      f.p.slice(1, -1).forEach((p, i) => { if (arm.moving[i]) spot(pen, p, "#e08a1e", 5); });
      spot(pen, f.p[f.p.length - 1], style("q"), 6);
      told.textContent = `t = ${f.t.toFixed(2)} s · ` + arm.names.map((n, i) => `${n}\u00a0${arm.turns[i] ? `${(f.q[i] * 180 / Math.PI).toFixed(1)}°` : `${f.q[i].toFixed(1)}\u00a0mm`}`).join(" · ");
    } else if (frames) {
      const p = frames.points[index];
      spot(pen, p, style("ink"), 7);
      told.textContent = `t = ${digits(frames.t[index])} ${frames.unit} · (${p.map(c => digits(c)).join(", ")}) mm · ${digits(frames.speed[index], 3)} ${frames.per}`;
    }
    if (slider) slider.value = index;
  }
  const index = () => Math.min(count - 1, Math.round(clock * (count - 1)));
  function tick(now) {
    if (!seen) { last = null; return; }
    if (playing && last !== null) clock = (clock + (now - last) / 7000) % 1.12;
    if (playing || stale) draw(Math.max(0, index()));
    last = now;
    if (playing || drag) requestAnimationFrame(tick); else last = null;
  }
  const again = () => { stale = true; if (!playing) requestAnimationFrame(tick); };
  const turned = (a, b) => { turn += a; tilt = Math.max(-1.5, Math.min(1.5, tilt + b)); again(); };
  const scaled = k => { zoom = Math.max(0.5, Math.min(12, zoom * k)); again(); };
  const play = on => { playing = on && count > 0; if (button) { button.textContent = on ? "Pause" : "Play"; } last = null; requestAnimationFrame(tick); };
  if (count) {
    slider.max = count - 1;
    button.onclick = () => play(!playing);
    slider.oninput = () => { clock = slider.value / slider.max; if (playing) play(false); stale = true; requestAnimationFrame(tick); };
  }
  canvas.onpointerdown = e => { drag = [e.clientX, e.clientY]; canvas.setPointerCapture(e.pointerId); if (!playing) requestAnimationFrame(tick); };
  canvas.onpointermove = e => { if (drag) { turned((drag[0] - e.clientX) / 150, (e.clientY - drag[1]) / 150); drag = [e.clientX, e.clientY]; } };
  canvas.onpointerup = canvas.onpointercancel = () => { drag = null; };
  canvas.addEventListener("wheel", e => { if (e.ctrlKey || e.metaKey) { e.preventDefault(); scaled(Math.exp(-e.deltaY / 400)); } }, { passive: false });
  canvas.onkeydown = e => {
    const move = { ArrowLeft: [0.15, 0], ArrowRight: [-0.15, 0], ArrowUp: [0, 0.12], ArrowDown: [0, -0.12] }[e.key];
    if (move) { e.preventDefault(); turned(...move); } else if (e.key === "+" || e.key === "-") scaled(e.key === "+" ? 1.25 : 0.8);
  };
  for (const b of box.querySelectorAll("[data-zoom]")) b.onclick = () => scaled(Number(b.dataset.zoom));
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", again);
  if (window.ResizeObserver) new ResizeObserver(again).observe(canvas); else addEventListener("resize", again);
  if (window.IntersectionObserver) new IntersectionObserver(list => { seen = list[list.length - 1].isIntersecting; if (seen) again(), requestAnimationFrame(tick); }).observe(canvas);
  addEventListener("beforeprint", () => { stale = true; draw(Math.max(0, index())); });
  play(playing);
  canvas.dataset.drawn = "yes";
}
for (const box of document.querySelectorAll("[data-scene]")) show(box, JSON.parse(box.querySelector("script").textContent));
})();
