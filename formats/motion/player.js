/* Plays the motion that the page holds. Objects: two vertices, birth, death, name. Knots of a vertex: time, x, y and the
 * control points of a parabola, one, or of a cubic, two (null: straight). Contacts: two objects, begin, end, 1 for a single instant. */
'use strict';
const $ = id => document.getElementById(id), picture = $('picture'), marks = $('marks');
const length = motion.end - motion.begin, shown = 1000, slack = length / 150;
const still = matchMedia('(prefers-reduced-motion: reduce)'), dark = matchMedia('(prefers-color-scheme: dark)');
const solid = motion.solid === true, film = solid && picture.querySelector('svg');
const bottom = 40, rim = 14;
let lasting = 0, left, now = motion.begin, playing = false, before = null, chosen = -1, colours, view, paths;
const contacts = joined(motion.contacts.sort((a, b) => a[2] - b[2])), rows = [];

/* -- numbers ---------------------------------------------------------------- */

const day = 86400000;
const plain = value => String(Number.isSafeInteger(value) ? value : +value.toPrecision(15));
const name = object => motion.objects[object][4] || (solid ? 'triangle ' : 'segment ') + object;

/* In space, contacts of the same two parts that follow one another without a gap are one. Those that last all the time,
 * as of a hinge, are counted only. */
function joined(all) {
  if (!solid) return all;
  const last = new Map(), out = [];
  all.forEach(c => {
    const key = [motion.objects[c[0]][4] || c[0], motion.objects[c[1]][4] || c[1]].sort().join('\n'), before = last.get(key);
    if (before && c[2] <= before[3]) { before[3] = Math.max(before[3], c[3]); before[4] = 0; return; }
    last.set(key, c); out.push(c);
  });
  const short = out.filter(c => c[2] > motion.begin || c[3] < motion.end);
  lasting = out.length - short.length;
  return short;
}
const title = c => name(c[0]) + ' · ' + name(c[1]);

/* Milliseconds as a clock shows them, hours:minutes:seconds in UTC; other times are numbers. */
function time(t, dated) {
  if (!motion.clock) return t.toFixed(motion.digits);
  const text = new Date(Math.round(t)).toISOString();
  return (dated && motion.end >= day ? text.slice(0, 10) + ' ' : '') + text.slice(11, length < 600000 ? 23 : 19);
}

/* Multiples of 1, 2 or 5 times a power of ten, as many as have room. */
function ticks(from, to, most) {
  const raw = Math.max((to - from) / Math.max(most, 1), 1e-300), power = 10 ** Math.floor(Math.log10(raw));
  const step = power * [1, 2, 5, 10].find(k => k * power >= raw * 0.999), out = [];
  for (let i = Math.ceil(from / step); i * step <= to && out.length < 50; i++) out.push(i * step);
  return out;
}

/* -- places ----------------------------------------------------------------- */

function place(plan, t) {
  let low = 0, high = plan.length - 1;
  while (high - low > 1) { const m = low + high >> 1; if (plan[m][0] <= t) low = m; else high = m; }
  const p = plan[low], q = plan[high], s = p === q ? 0 : Math.min(1, Math.max(0, (t - p[0]) / (q[0] - p[0]))), r = 1 - s;
  return [1, 2].map(k => p[3] === null ? r * p[k] + s * q[k] : p.length < 7 ? r * r * p[k] + 2 * r * s * p[k + 2] + s * s * q[k]
    : r * r * r * p[k] + 3 * r * s * (r * p[k + 2] + s * p[k + 4]) + s * s * s * q[k]);
}
const ends = object => [0, 1].map(k => place(motion.vertices[motion.objects[object][k]], now));

/* The point of a segment that is nearest to a point. */
function nearest([p, q], x) {
  const d = [q[0] - p[0], q[1] - p[1]], square = d[0] * d[0] + d[1] * d[1];
  const s = square ? Math.min(1, Math.max(0, ((x[0] - p[0]) * d[0] + (x[1] - p[1]) * d[1]) / square)) : 0;
  return [p[0] + s * d[0], p[1] + s * d[1]];
}
/* Where two segments meet or nearly do: of their four ends the one that is nearest to the other segment. */
function meeting(c) {
  const a = ends(c[0]), b = ends(c[1]);
  const far = (x, s) => { const y = nearest(s, x); return Math.hypot(x[0] - y[0], x[1] - y[1]); };
  return [...a.map(x => [far(x, b), x]), ...b.map(x => [far(x, a), x])].sort((x, y) => x[0] - y[0])[0][1];
}
const isOn = c => c[2] <= now && now <= Math.max(c[3], c[2] + slack);

/* -- picture ---------------------------------------------------------------- */

function fit(canvas, width, height) {
  const dense = window.devicePixelRatio || 1;
  canvas.style.height = height + 'px';
  canvas.width = Math.round(width * dense); canvas.height = Math.round(height * dense);
  const pen = canvas.getContext('2d');
  pen.scale(dense, dense);
  return pen;
}

/* The scale, the frame, and the roads: what all objects pass from begin to end. */
function lay() {
  const style = getComputedStyle(document.documentElement);
  colours = Object.fromEntries(['ink', 'soft', 'line', 'faint', 'mark', 'hit', 'card']
    .map(key => [key, style.getPropertyValue('--' + key).trim()]));
  if (solid) {
    view = {width: picture.parentElement.clientWidth};
    view.marks = fit(marks, view.width, 22);
    drawMarks();
    return draw();
  }
  const width = picture.parentElement.clientWidth, [across, up] = [0, 1].map(k => motion.hi[k] - motion.lo[k]);
  left = 30 + 7 * Math.max(...ticks(motion.lo[1], motion.hi[1], 6).map(t => plain(t).length), 1);
  const room = width - left - rim, most = Math.max(240, 0.68 * innerHeight);
  const scale = Math.min(across ? room / across : 1 / 0, up ? (most - bottom - rim) / up : 1 / 0);
  const height = Math.max(120, Math.ceil((up && isFinite(scale) ? up * scale : 0) + bottom + rim));
  const s = isFinite(scale) ? scale : 1;
  view = {width, height, scale: s, x: left + room / 2 - s * (motion.lo[0] + across / 2),
          y: rim + (height - bottom - rim) / 2 + s * (motion.lo[1] + up / 2)};
  view.pen = fit(picture, width, height);
  view.marks = fit(marks, width, 22);
  paths = new Path2D();
  motion.vertices.forEach(plan => plan.forEach((k, i) => {
    const points = i && plan[i - 1][3] !== null ? plan[i - 1].slice(3) : [];
    paths[!i ? 'moveTo' : ['lineTo', 'quadraticCurveTo', 'bezierCurveTo'][points.length / 2]](...points, k[1], k[2]);
  }));
  drawMarks();
  draw();
}
const at = (v, p) => [v.x + v.scale * p[0], v.y - v.scale * p[1]];

function axes(pen) {
  const {width, height, scale} = view, base = height - bottom;
  pen.font = '12px system-ui, sans-serif'; pen.lineWidth = 1;
  const line = (x0, y0, x1, y1) => { pen.beginPath(); pen.moveTo(x0, y0); pen.lineTo(x1, y1); pen.stroke(); };
  const value = (x, y) => [(x - view.x) / scale, (view.y - y) / scale];
  const [from, low] = value(left, base), [to, high] = value(width - rim, rim);
  pen.strokeStyle = colours.faint; pen.fillStyle = colours.soft;
  pen.textAlign = 'center';
  ticks(from, to, (width - left) / 90).forEach(t => { const x = at(view, [t, 0])[0];
    line(x, rim, x, base); pen.fillText(plain(t), x, base + 16); });
  pen.textAlign = 'right';
  ticks(low, high, (base - rim) / 60).forEach(t => { const y = at(view, [0, t])[1];
    line(left, y, width - rim, y); pen.fillText(plain(t), left - 6, y + 4); });
  pen.fillText('x, in units of the file', width - rim, height - 6);
  pen.save(); pen.translate(12, rim); pen.rotate(-Math.PI / 2); pen.fillText('y, in units of the file', 0, 0); pen.restore();
  pen.strokeStyle = colours.line;
  pen.strokeRect(left + .5, rim + .5, width - rim - left, base - rim);
}

/* Roads faint, objects strong, those in contact stronger. */
function paint(pen, v, touching, weight) {
  pen.lineCap = pen.lineJoin = 'round';
  pen.save();
  pen.transform(v.scale, 0, 0, -v.scale, v.x, v.y);
  pen.strokeStyle = colours.line; pen.lineWidth = 1.6 / v.scale;
  pen.stroke(paths);
  pen.restore();
  for (const red of [false, true]) {
    pen.strokeStyle = red ? colours.hit : colours.mark; pen.lineWidth = red ? 1.4 * weight : weight;
    pen.beginPath();
    motion.objects.forEach((o, i) => {
      if (now < o[2] || now > o[3] || touching.has(i) !== red) return;
      const [p, q] = ends(i);
      pen.moveTo(...at(v, p)); pen.lineTo(...at(v, q));
    });
    pen.stroke();
  }
}

/* A glass over a contact whose objects are small: the two as large as a finger. */
function magnify(pen, c, touching) {
  const spans = [c[0], c[1]].map(o => { const [p, q] = ends(o); return Math.hypot(p[0] - q[0], p[1] - q[1]); });
  const size = Math.max(...spans) * view.scale, times = Math.min(40 / Math.max(size, 1e-9), 1e6);
  const m = meeting(c), [x, y] = at(view, m), r = Math.min(90, view.width / 6, (view.height - bottom) / 3);
  pen.strokeStyle = colours.hit; pen.lineWidth = 2;
  pen.beginPath(); pen.arc(x, y, 12, 0, 7); pen.stroke();
  if (times < 2 || r < 30) return;
  const cx = x < view.width / 2 ? view.width - rim - r - 12 : left + r + 12;
  const cy = y < (view.height - bottom) / 2 ? view.height - bottom - r - 12 : rim + r + 12;
  const away = Math.hypot(cx - x, cy - y);
  pen.beginPath(); pen.moveTo(x + 12 * (cx - x) / away, y + 12 * (cy - y) / away);
  pen.lineTo(cx - r * (cx - x) / away, cy - r * (cy - y) / away); pen.lineWidth = 1; pen.stroke();
  pen.save();
  pen.beginPath(); pen.arc(cx, cy, r, 0, 7); pen.fillStyle = colours.card; pen.fill(); pen.clip();
  const scale = view.scale * times;
  paint(pen, {scale, x: cx - scale * m[0], y: cy + scale * m[1]}, touching, 6);
  pen.restore();
  pen.strokeStyle = colours.hit; pen.lineWidth = 2;
  pen.beginPath(); pen.arc(cx, cy, r, 0, 7); pen.stroke();
}

/* The film at its time; borders of what is in contact. */
function seek(on) {
  const names = new Set(on.flatMap(i => [name(contacts[i][0]), name(contacts[i][1])]));
  film.setCurrentTime(Math.min((now - motion.begin) / length, 0.9999999) * motion.seconds);
  film.querySelectorAll('path[fill]').forEach(path => path.classList.toggle('hit', names.has(path.dataset.group)));
}

function draw() {
  const pen = view.pen, touching = new Set(), on = [];
  contacts.forEach((c, i) => { if (isOn(c)) { on.push(i); touching.add(c[0]).add(c[1]); } });
  const glass = chosen >= 0 && isOn(contacts[chosen]) ? chosen : on.length ? on[on.length - 1] : -1;
  if (solid) seek(on); else paintAll(pen, touching, glass);
  $('time').value = (now - motion.begin) / length;
  $('now').textContent = time(now);
  $('time').setAttribute('aria-valuetext', time(now, true));
  follow(glass);
}

function paintAll(pen, touching, glass) {
  pen.clearRect(0, 0, view.width, view.height);
  axes(pen);
  pen.save();
  pen.beginPath(); pen.rect(left, rim, view.width - rim - left, view.height - bottom - rim); pen.clip();
  paint(pen, view, touching, 4);
  pen.restore();
  if (glass >= 0) magnify(pen, contacts[glass], touching);
}

/* -- time line and list ----------------------------------------------------- */

const thumb = 8, across = t => thumb + (t - motion.begin) / length * (view.width - 2 * thumb);

function drawMarks() {
  const pen = view.marks;
  pen.clearRect(0, 0, view.width, 22);
  pen.fillStyle = colours.faint; pen.fillRect(thumb, 2, view.width - 2 * thumb, 18);
  pen.fillStyle = colours.hit;
  contacts.forEach(c => pen.fillRect(across(c[2]) - 2, 2, Math.max(4, across(c[3]) - across(c[2])), 18));
}

let last = -2;
function follow(glass) {
  rows.forEach((row, i) => { const c = contacts[i]; row.className = isOn(c) ? 'on' : c[2] < now ? 'past' : ''; });
  if (glass === last) return;
  rows.forEach((row, i) => i === glass ? row.setAttribute('aria-current', 'true') : row.removeAttribute('aria-current'));
  if (rows[glass]) { const box = $('box'), row = rows[glass], top = row.offsetTop - box.offsetTop;
    if (top < box.scrollTop || top + row.offsetHeight > box.scrollTop + box.clientHeight)
      box.scrollTop = top - box.clientHeight / 3; }
  last = glass;
}

function list() {
  $('title').textContent = !contacts.length ? 'No contacts' :
    contacts.length + (contacts.length > 1 ? ' contacts' : ' contact') +
    (contacts.length > shown ? ', the first ' + shown + ':' : '');
  $('box').hidden = !contacts.length;
  contacts.slice(0, shown).forEach((c, i) => {
    const item = document.createElement('li'), row = document.createElement('button');
    [['b', name(c[0])], ['span', time(c[2])], ['b', name(c[1])],
     ['span', c[4] ? 'one instant' : 'to ' + time(c[3])]].forEach(([tag, text]) =>
      row.appendChild(document.createElement(tag)).textContent = text);
    row.type = 'button';
    row.onclick = () => { stop(); show(i); };
    rows.push(row);
    item.append(row); $('list').append(item);
  });
}

/* -- playing ---------------------------------------------------------------- */

function go(t) { now = Math.min(motion.end, Math.max(motion.begin, t)); draw(); }
function say(text) { $('say').textContent = text; }
function show(i) { chosen = i; go(contacts[i][2]); say(time(now, true) + ': ' + title(contacts[i])); }
function stop() { playing = false; $('play').textContent = 'Play'; }
function play() {
  if (now >= motion.end) now = motion.begin;
  playing = true; before = null; $('play').textContent = 'Pause'; requestAnimationFrame(step);
}
function step(clock) {
  if (!playing) return;
  const from = now;
  let to = before === null ? now : now + (clock - before) / 1000 / motion.seconds * length * $('speed').value;
  before = clock;
  const next = $('halt').checked ? contacts.findIndex(c => c[2] > from && c[2] <= to) : -1;
  if (next >= 0) { stop(); return show(next); }
  if (to > motion.end) to = motion.begin;
  go(to);
  requestAnimationFrame(step);
}
/* The contact before or after now. */
function jump(way) {
  const i = way > 0 ? contacts.findIndex(c => c[2] > now) : contacts.findLastIndex(c => c[2] < now);
  stop();
  if (i >= 0) show(i); else go(way > 0 ? motion.end : motion.begin);
}
$('play').onclick = () => playing ? stop() : play();
$('back').onclick = () => jump(-1);
$('next').onclick = () => jump(1);
$('time').oninput = e => { stop(); go(motion.begin + e.target.value * length); };
marks.onpointerdown = e => { stop();
  const t = motion.begin + (e.offsetX - thumb) / (view.width - 2 * thumb) * length, reach = 8 / view.width * length;
  const i = contacts.findIndex(c => c[2] - reach <= t && t <= c[3] + reach);
  if (i >= 0) show(i); else go(t); };
document.addEventListener('keydown', e => {
  const own = e.target.closest('button, select, input[type=checkbox]'), step = length / 100;
  if (e.altKey || e.ctrlKey || e.metaKey) return;
  if (e.key === ' ' && !own) playing ? stop() : play();
  else if (e.key === 'ArrowLeft' && e.target.tagName !== 'SELECT') e.shiftKey ? jump(-1) : (stop(), go(now - step));
  else if (e.key === 'ArrowRight' && e.target.tagName !== 'SELECT') e.shiftKey ? jump(1) : (stop(), go(now + step));
  else return;
  e.preventDefault();
});
if (film) {
  film.querySelector('style').remove(); /* the page itself does not play where less motion is wanted */
  film.removeAttribute('width'); film.removeAttribute('height');
  film.pauseAnimations();
}
list();
picture.parentElement.style.maxWidth = motion.width + 'px';
$('first').textContent = time(motion.begin, true);
$('final').textContent = time(motion.end, true);
$('among').textContent = 'of ' + motion.objects.length + (solid ? ' moving triangle' : ' moving segment') +
  (motion.objects.length === 1 ? '' : 's') +
  (lasting ? '; ' + lasting + (lasting > 1 ? ' pairs touch' : ' pair touches') + ' all the time' : '') +
  (motion.clock ? '. Times are hours, minutes and seconds, UTC.' : '. Times are numbers of the file.');
new ResizeObserver(lay).observe(picture.parentElement);
dark.addEventListener('change', lay);
lay();
const share = parseFloat(location.hash.slice(1)); /* page.html#0.5 stands still in the middle */
if (share >= 0) go(motion.begin + share * length); else if (!still.matches) play();
