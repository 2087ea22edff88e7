// The window: anyone who has the link watches the match through the director's cameras.
import {Connection} from './connection.js';
import {Feed} from './feed.js';
import {Rows, shotEntry} from './lists.js';
import {colourOf, nameOf} from './palette.js';
import {FrameBuffer, PlayoutClock} from './playout.js';
import {decodeFrame, version} from './protocol.js';
import {attachScrubbing} from './scrubbing.js';
import * as server from './server.js';
import {Stage} from './stage.js';
import {Timeline} from './timeline.js';
import {TimelineView, modeOf, modeText, reasonText} from './timeline_view.js';
import {Viewpoint, attach} from './viewpoint.js';

const listPeriodMs = 3000;
const maxPictures = 3;
const stepMs = 5000;

const find = id => document.getElementById(id);
const calm = matchMedia('(prefers-reduced-motion: reduce)');

const buffer = new FrameBuffer();
const clock = new PlayoutClock();
const timeline = new Timeline();
const viewpoint = new Viewpoint();
const shotRows = new Rows(find('shots'), 'No camera is on: no spectator has asked for one.');
const matchRows = new Rows(find('matches'), 'No match is running.');

const feed = new Feed(find('feed'), look);
const timelineView = new TimelineView(find('timeline'));

let stage = null;
let match = null;         // the last note of the match
let players = new Map();  // by slot
let listed = [];          // of /live
let camera = null;        // the id of the camera that is shown
let view = 'camera';
let pictures = !calm.matches;
let connection = {state: 'none'};  // to no match yet
let sample = null;
let mapShown = null;      // its name
let obstaclesNote = '';
let dropped = 0;
let noticeTimer = 0;
let framesDrawn = 0;
let drawRate = 0;
let dirty = true;

const now = () => performance.now();
const step = () => match?.position_step ?? 1;

function look(slot) {
    const player = players.get(slot);
    return {colour: slot === null ? '#9aa6b5' : colourOf(player, [...players.values()]), name: nameOf(player),
        number: slot === null ? '–' : String(slot + 1)};
}

const link = new Connection(server.token, {
    state(state, retryMs) {
        connection = {state, retryAt: retryMs === undefined ? null : now() + retryMs};
        dirty = true;
    },
    note(note) {
        ({match: onMatch, history: onHistory, cut: onMark, event: onMark, dropped: onDropped, end: onEnd})[note.kind]?.(note);
        dirty = true;
    },
    frame(data) {
        if (!buffer.add(data)) return;
        const frame = decodeFrame(data, step());
        if (!frame) return;
        clock.arrived(frame.t, now());
        timeline.addFrame(frame);
        age = Date.now() - frame.sourceTime;
    },
});
let age = null;  // ms between the game server's clock and this one, when the last frame arrived

function onMatch(note) {
    if (note.version !== version) return showMessage('The server speaks another version: reload this page.');
    const begins = !match || match.match_id !== note.match_id || match.epoch !== note.epoch || match.ended;
    if (begins) {
        buffer.clear();
        timeline.clear();
        clock.reset();
        sample = null;
    }
    match = note;
    players = new Map(note.players.map(player => [player.slot, player]));
    stage.setScale(note.metres_per_unit);
    stage.setLooks(slot => ({...look(slot), label: look(slot).name}));
    find('match-name').textContent = note.match_id;
    find('map-name').textContent = note.map;
    document.title = `${note.match_id} · Camera director`;
    showMap(note.map);
}

function onHistory(note) {
    timeline.clear();
    timeline.addHistory(note);
}

function onMark(note) {
    timeline.addNote(note);
}

function onDropped(note) {
    dropped += note.frames;
    notice(`${note.frames} frames skipped: this connection is slow`);
}

function onEnd() {
    match.ended = true;
    notice('The match has ended');
}

function notice(text) {
    find('notice').textContent = text;
    find('notice').hidden = false;
    clearTimeout(noticeTimer);
    noticeTimer = setTimeout(() => { find('notice').hidden = true; }, 4000);
}

function showMessage(text, asksForToken = false) {
    find('message').hidden = text === '';
    find('message-text').textContent = text;
    find('token-form').hidden = !asksForToken;
}

// Obstacles where the server has them, and the medial mesh.
async function showMap(name) {
    if (mapShown === name) return;
    mapShown = name;
    stage.clearMap();
    let obstacles;
    let mesh;
    try {
        obstacles = await server.model(name, 'obstacles.glb');
        mesh = await server.model(name, 'mesh.glb');
    } catch {
        mapShown = null;  // asked for with the next list
        return;
    }
    if (mapShown !== name) return;
    if (obstacles.file) stage.setObstacles(obstacles.file);
    if (mesh.file) stage.setMesh(mesh.file);
    obstaclesNote = obstacles.file ? '' : mesh.file
        ? `Only the free space of this map can be shown: ${obstacles.reason}.`
        : `This map cannot be shown: ${mesh.reason}.`;
    find('map-note').textContent = obstaclesNote;
    find('map-note').hidden = obstaclesNote === '';
    if (!mesh.file && !obstacles.file) mapShown = null;  // it may be loading still: asked for with the next list
    find('mesh').checked = !obstacles.file;
    if (stage.hasMap) viewpoint.fit(stage.bounds, find('stage').clientWidth / find('stage').clientHeight);
    dirty = true;
}

async function refreshList() {
    try {
        const answer = await server.ask('/live');
        if (answer.status === 401) {
            showMessage('This server asks for a token.', true);
        } else if (answer.ok) {
            listed = (await answer.json()).matches;
            showMessage(listed.length === 0 ? 'No match is running. This page shows one as soon as it begins.' : '');
            chooseMatch();
            if (match && mapShown === null) showMap(match.map);
        }
    } catch {
        link.unreachable();
        if (!match) showMessage('The server cannot be reached. Trying again.');
    }
    dirty = true;
    setTimeout(refreshList, listPeriodMs);
}

function chooseMatch() {
    const known = listed.find(entry => entry.match_id === link.matchId);
    if (known && !(match?.ended)) return;
    const wanted = listed.find(entry => entry.match_id === (link.matchId ?? server.matchOfAddress)) ?? listed[0];
    if (wanted) watch(wanted.match_id);
}

function watch(matchId) {
    if (link.matchId !== undefined) server.rememberMatch(matchId);
    camera = null;
    link.watch(matchId);
}

function chooseCamera(id) {
    camera = id;
    dirty = true;
}

function setView(name) {
    view = name;
    for (const button of document.querySelectorAll('[data-view]')) {
        button.setAttribute('aria-checked', button.dataset.view === name);
        button.tabIndex = button.dataset.view === name ? 0 : -1;
    }
    find('tools').hidden = name === 'camera';
    find('stage').dataset.view = name;
    dirty = true;
}

function stepCamera(by) {
    const ids = shownCameras().map(shot => shot.id);
    if (ids.length > 0) chooseCamera(ids[(ids.indexOf(camera) + by + ids.length) % ids.length]);
}

function seek(t) {
    clock.seek(Math.min(Math.max(t, buffer.first ?? t), buffer.last ?? t));
    dirty = true;
}

function stepCut(by) {
    const cuts = timeline.cuts.filter(cut => cut.camera === camera);
    const next = by > 0 ? cuts.find(cut => cut.t > clock.t + 1) : cuts.filter(cut => cut.t < clock.t - 1000).pop();
    if (next) seek(next.t);
}

function setPaused(paused) {
    clock.setPaused(paused);
    dirty = true;
}

function goLive() {
    clock.goLive();
    dirty = true;
}

function shownCameras() {
    return sample ? [...sample.cameras.values()].sort((a, b) => (a.target ?? 256) - (b.target ?? 256) || a.id - b.id) : [];
}

// Whether something can be drawn through a camera.
function shownCamera() {
    return sample?.cameras.get(camera) ?? null;
}

function stateText() {
    if (connection.state === 'waiting')
        return ['waiting', `Reconnecting in ${Math.max(1, Math.round((connection.retryAt - now()) / 1000))} s`];
    if (connection.state === 'none') return ['empty', 'No match'];
    if (connection.state === 'connecting') return ['connecting', match ? 'Reconnecting' : 'Connecting'];
    if (match?.ended) return ['ended', 'Ended'];
    const entry = listed.find(other => other.match_id === match?.match_id);
    if (connection.state === 'silent') return ['silent', entry ? `No frames: ${entry.state}` : 'No frames'];
    if (buffer.last === null) return ['empty', entry ? entry.state : 'No frames yet'];
    const behind = buffer.last - clock.t;
    if (clock.paused) return ['paused', `Paused, ${seconds(behind)} behind`];
    if (!clock.live) return ['behind', `${seconds(behind)} behind`];
    const late = age !== null && age > -1000 && age < 600e3 ? Math.max(age, 0) + behind : behind;
    return ['live', `Live · ${seconds(late)} after the game`];
}

function seconds(ms) {
    return `${(ms / 1000).toFixed(1)} s`;
}

function clockText(ms) {
    const whole = Math.floor(ms / 1000);
    const minutes = Math.floor(whole / 60);
    return `${minutes}:${String(whole % 60).padStart(2, '0')}.${Math.floor(ms / 100) % 10}`;
}

function setText(id, text) {
    if (find(id).textContent !== text) find(id).textContent = text;
}

function showState() {
    const [state, text] = stateText();
    const element = find('state');
    if (element.dataset.state !== state) {
        element.dataset.state = state;
        setText('announcement', text);  // read out now, not with every tenth of a second
    }
    const label = element.querySelector('span');
    if (label.textContent !== text) label.textContent = text;
    find('live').setAttribute('aria-pressed', clock.live && !clock.paused);
    const playing = !clock.paused;
    if (find('play').dataset.playing !== String(playing)) {
        find('play').dataset.playing = playing;
        find('play').setAttribute('aria-label', playing ? 'Pause' : 'Play');
        find('play').querySelector('path').setAttribute('d', playing ? 'M4 2h3v12H4zM9 2h3v12H9z' : 'M4 2l9 6-9 6z');
    }
    setText('clock', clock.t === null ? '' : clockText(clock.t));
}

function showCaption() {
    const shot = shownCamera();
    const name = find('caption-name');
    const state = find('caption-state');
    name.hidden = state.hidden = !shot;
    if (!shot) return;
    const {name: text, colour} = look(shot.target);
    setText('caption-name', text);
    name.style.borderColor = colour;
    const mode = modeOf(shot.flags);
    const cut = timeline.cutBefore(camera, clock.t);
    const fresh = cut && clock.t - cut.t < 2500 ? ` · cut: ${reasonText(cut, slot => look(slot).name)}` : '';
    state.dataset.mode = mode;
    setText('caption-state', modeText[mode] + fresh);
}

function showLists() {
    const entry = listed.find(other => other.match_id === match?.match_id);
    const profiles = new Map((entry?.shots ?? []).map(shot =>
        [shot.camera_id, shot.automatic ? `${shot.profile}, the director chooses` : shot.profile]));
    shotRows.show(shownCameras().map(shot =>
        shotEntry(shot, look(shot.target), profiles.get(shot.id) ?? '', shot.id === camera, () => chooseCamera(shot.id))));
    matchRows.show(listed.map(other => ({
        key: `match ${other.match_id}`, number: String(other.players.length), colour: '#c4ccd6', name: other.match_id,
        detail: `${other.map}, ${other.state}`, pressed: other.match_id === link.matchId,
        choose: () => watch(other.match_id),
    })));
}

// Buttons over the small pictures, as many as are shown.
function pictureShots() {
    if (!pictures || view !== 'camera' && !shownCamera()) return [];
    return shownCameras().filter(shot => view !== 'camera' || shot.id !== camera).slice(0, maxPictures);
}

function layPictures(shots) {
    const holder = find('pictures');
    while (holder.children.length > shots.length) holder.lastChild.remove();
    while (holder.children.length < shots.length) {
        const button = document.createElement('button');
        button.type = 'button';
        button.append(document.createElement('span'));
        holder.append(button);
    }
    shots.forEach((shot, i) => {
        const button = holder.children[i];
        const {name, colour} = look(shot.target);
        const label = button.firstChild;
        if (label.textContent !== name) label.textContent = name;
        label.style.color = colour;
        button.onclick = () => { chooseCamera(shot.id); setView('camera'); };
    });
}

function resize() {
    const {clientWidth, clientHeight} = find('stage');
    const ratio = Math.min(devicePixelRatio, 2);
    const size = `${clientWidth} ${clientHeight} ${ratio}`;
    if (size === resize.last || clientWidth === 0) return;
    resize.last = size;
    stage.resize(clientWidth, clientHeight, ratio);
    dirty = true;
}

function drawStage() {
    const {clientWidth: width, clientHeight: height} = find('stage');
    const whole = {x: 0, y: 0, width, height};
    stage.begin();
    const shots = pictureShots();
    layPictures(shots);
    const shot = shownCamera();
    if (sample) stage.show(sample, camera);
    if (stage.mesh) stage.mesh.visible = find('mesh').checked;
    const [low, high] = stage.heights;
    stage.cut = low + (high - low) * Number(find('cut').value) + 1;
    if (view !== 'camera' && find('follow').checked && shot) {
        const followed = sample.players.get(shot.target);
        if (followed) viewpoint.centre.set(...followed.position);
    }
    if (view === 'camera' && shot) stage.drawThrough(shot, whole);
    else if (view === 'plan') stage.drawPlan(viewpoint, whole);
    else stage.drawOrbit(viewpoint, whole);
    const origin = find('stage').getBoundingClientRect();
    shots.forEach((small, i) => {
        const place = find('pictures').children[i].getBoundingClientRect();
        if (place.width === 0) return;
        stage.drawThrough(small, {x: place.left - origin.left, y: place.top - origin.top, width: place.width, height: place.height}, false);
    });
    ++framesDrawn;
}

function drawTimeline() {
    const first = buffer.first ?? 0;
    const last = buffer.last ?? 0;
    const element = find('timeline');
    element.setAttribute('aria-valuemin', Math.round(first));
    element.setAttribute('aria-valuemax', Math.round(last));
    element.setAttribute('aria-valuenow', Math.round(clock.t ?? 0));
    element.setAttribute('aria-valuetext', `${seconds(last - (clock.t ?? last))} before the newest frame`);
    if (buffer.last !== null)
        timelineView.draw({timeline, camera, t: clock.t, first, last, colourOfSlot: slot => look(slot).colour});
}

let lastPanel = 0;
function frame() {
    const at = now();
    const shownBefore = clock.t;
    clock.advance(at, buffer.first, buffer.last);
    resize();
    if (clock.t !== shownBefore || dirty) {
        dirty = false;
        sample = clock.t === null ? null
            : buffer.sample(clock.t, step(), (id, from, to) => timeline.cutBetween(id, from, to));
        if (!shownCamera()) camera = shownCameras()[0]?.id ?? camera;
        drawStage();
        showCaption();
        feed.show(timeline.events, clock.t);
    }
    if (at - lastPanel > 120) {
        drawRate = framesDrawn * 1000 / (at - lastPanel) * 0.2 + drawRate * 0.8;
        framesDrawn = 0;
        lastPanel = at;
        showState();
        showLists();
        drawTimeline();
    }
    requestAnimationFrame(frame);
}

const keys = {
    '1': () => setView('camera'),
    '2': () => setView('orbit'),
    '3': () => setView('plan'),
    n: () => stepCamera(1),
    p: () => stepCamera(-1),
    ' ': () => setPaused(!clock.paused),
    j: () => seek(clock.t - stepMs),
    k: () => seek(clock.t + stepMs),
    '[': () => stepCut(-1),
    ']': () => stepCut(1),
    l: goLive,
    f: () => find('follow').click(),
    m: () => find('mesh').click(),
    i: () => { pictures = !pictures; },
    c: () => moveCut(-0.05),
    C: () => moveCut(0.05),
    '?': () => find('help').showModal(),
};

function moveCut(by) {
    find('cut').value = Number(find('cut').value) + by;
}

document.addEventListener('keydown', event => {
    if (event.ctrlKey || event.metaKey || event.altKey || find('help').open) return;
    const {target} = event;
    if (target.matches('input:not([type=checkbox])')) return;
    if (event.key === ' ' && target.matches('button, input')) return;  // presses it
    const handled = target === find('canvas') && view !== 'camera' && viewpoint.key(event, view === 'plan');
    const action = handled ? () => {} : keys[event.key] ?? (event.shiftKey ? undefined : keys[event.key.toLowerCase()]);
    if (!action) return;
    event.preventDefault();
    action();
    dirty = true;
});

attachScrubbing(find('timeline'), find('tip'), {
    range: () => buffer.last === null ? null : [buffer.first, buffer.last],
    now: () => clock.t,
    timeAt: clientX => timelineView.timeAt(clientX, buffer.first, buffer.last),
    describe: describeTime,
    seek,
    goLive,
});

// What the shot did at a time, and the nearest cut.
function describeTime(t) {
    const span = timeline.spans(camera, t, t + 1)[0];
    const near = timeline.cuts.filter(cut => cut.camera === camera && Math.abs(cut.t - t) < 1500)
        .sort((a, b) => Math.abs(a.t - t) - Math.abs(b.t - t))[0];
    const parts = [`−${seconds(buffer.last - t)}`];
    if (span) parts.push(`${look(span.target).name}: ${modeText[modeOf(span.flags)].toLowerCase()}`);
    if (near) parts.push(`cut: ${reasonText(near, slot => look(slot).name)}`);
    return parts.join(' · ');
}

for (const button of document.querySelectorAll('[data-view]')) {
    button.addEventListener('click', () => setView(button.dataset.view));
    button.addEventListener('keydown', event => {
        const by = {ArrowLeft: -1, ArrowRight: 1}[event.key];
        if (!by) return;
        const all = [...document.querySelectorAll('[data-view]')];
        const next = all[(all.indexOf(button) + by + all.length) % all.length];
        setView(next.dataset.view);
        next.focus();
    });
}
find('help-open').addEventListener('click', keys['?']);
find('back').addEventListener('click', keys.j);
find('ahead').addEventListener('click', keys.k);
find('play').addEventListener('click', keys[' ']);
find('live').addEventListener('click', goLive);
for (const id of ['cut', 'mesh', 'follow']) find(id).addEventListener('input', () => { dirty = true; });
find('token-form').addEventListener('submit', event => {
    event.preventDefault();
    server.setToken(find('token').value);
    showMessage('Opening');
});
document.addEventListener('visibilitychange', () => { dirty = true; });

// For tests and for whoever is curious: what is drawn.
window.cameraDirector = {
    redraw: drawStage,  // the canvas keeps its picture only until the browser has shown it
    state: () => ({
        connection: connection.state, state: find('state').dataset.state, match: match?.match_id ?? null, map: match?.map ?? null,
        view, camera, time: clock.t, first: buffer.first, last: buffer.last, live: clock.live, paused: clock.paused,
        frames: buffer.frames.length, dropped, drawRate, age,
        players: sample ? [...sample.players.values()].map(player => ({...player, id: players.get(player.slot)?.id,
            name: nameOf(players.get(player.slot))})) : [],
        cameras: shownCameras().map(shot => ({...shot, target: players.get(shot.target)?.id ?? null})),
        cuts: timeline.cuts.length, events: timeline.events.length,
        obstacles: Boolean(stage?.obstacles), mesh: Boolean(stage?.mesh), note: obstaclesNote,
    }),
};

try {
    stage = new Stage(find('canvas'));
    attach(find('canvas'), viewpoint, {
        active: () => view !== 'camera' || !shownCamera(),
        isPlan: () => view === 'plan',
        changed: () => { dirty = true; },
    });
    setView('camera');
    refreshList();
    requestAnimationFrame(frame);
} catch (error) {
    showMessage(`This page needs WebGL: ${error.message}`);
}
