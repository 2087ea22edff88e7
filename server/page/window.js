// The window: anyone who has the link watches the match through the director's cameras.
import {Broadcast, Refused} from './broadcast.js';
import {choose, isFull} from './choice.js';
import {silenceMs} from './connection.js';
import {Feed} from './feed.js';
import {Rows, shotEntry} from './lists.js';
import {latencyText} from './latency.js';
import {LiveSource} from './live_source.js';
import {findMatches} from './matches.js';
import {Model} from './model.js';
import {nameOf} from './palette.js';
import {Playback, kept} from './playback.js';
import {Quality, levelOfProcessor, levels, scaleOf} from './quality.js';
import {attachScrubbing} from './scrubbing.js';
import {SearchMark, searchesOf} from './searches.js';
import * as server from './server.js';
import {ShownMap} from './shown_map.js';
import {Stage} from './stage.js';
import {TimelineView, modeOf, modeText, reasonText} from './timeline_view.js';
import {Viewpoint, attach} from './viewpoint.js';
import {clockText, seconds, stateText} from './words.js';

const listPeriodMs = 3000;
const fullForMs = 60e3;   // a stream that had no room is not tried again before
const maxPictures = 3;
const stepMs = 5000;
const noticeMs = 6000;

const find = id => document.getElementById(id);
const calm = matchMedia('(prefers-reduced-motion: reduce)');

const model = new Model();
model.begin(kept);
const viewpoint = new Viewpoint();
const shotRows = new Rows(find('shots'));
const matchRows = new Rows(find('matches'));

const look = slot => model.look(slot);
// Of the players of a group shot a frame has the first alone: all of them, of no other shot any.
const groupOf = id => watched?.stream?.shots.find(({camera_id: camera}) => camera === id)?.group ?? [];
function lookOfShot(shot) {
    if (modeOf(shot) === 'fixed') return {...look(null), name: map.nameOfCamera(shot.position)};
    const group = groupOf(shot.id);
    return group.length > 0 ? {...look(shot.target), name: group.map(nameOf).join(', ')} : look(shot.target);
}
const textOfShot = shot => modeText(shot, groupOf(shot.id).length > 0);
const feed = new Feed(find('feed'), look);
const timelineView = new TimelineView(find('timeline'));
const searchMark = new SearchMark(find('search-mark'));

let stage = null;
let map = null;           // ShownMap
let quality = null;
let source = null;        // LiveSource or Playback: what feeds the model
let watched = null;       // the entry of `matches` that it shows
let missed = 0;           // lists in a row that did not have its stream
let fullUntil = 0;        // its stream has no room
let runsSince = null;     // when lists began to say that it runs; null: they do not
let linked = server.matchOfAddress;  // the match of a link that is not in the list yet, until the viewer looks at another on purpose
let matches = [];         // of findMatches
let camera = null;        // the id of the camera that is shown
let wished = null;        // the one that the viewer has chosen, which may not be there at the time that is shown
let view = 'camera';
let pictures = !calm.matches;
let sample = null;
let searches = new Map();  // of it
let noticeTimer = 0;
let framesDrawn = 0;
let framesCounted = 0;  // in drawRate
let drawRate = 0;
let dirty = true;
let untold = true;        // the time that is shown, to screen readers
let toldSpeed = null;     // the clock's, that the control has; null: the viewer has changed it

const now = () => performance.now();
const isRecorded = () => source instanceof Playback;

const reports = {
    begin: forget,
    match: showMatch,
    problem: notice,
    change: () => { dirty = true; },
    token: () => showMessage('This server asks for a token.', true),
    newest: goLive,
    restart: () => watch(watched.id),
};

// From now on the match's stream, where it has one, else its broadcast: from the newest where it goes on, else from the
// begin, or as `begin` says (Playback.open).
function watch(id, begin) {
    const entry = matches.find(other => other.id === id);
    if (!entry) return;
    if (watched?.id !== id) {
        camera = wished = runsSince = null;
        fullUntil = 0;
        showHeader(id, entry.map);
        map.load(entry.map);
    }
    watched = entry;
    missed = 0;
    source?.close();
    if (entry.stream && !begin) {
        source = new LiveSource(id, model, server.token, reports);
    } else {
        source = new Playback(new Broadcast(entry.sync, server.ask), model, reports);
        source.open(begin ?? (entry.goesOn ? {} : {t: 0}));
    }
    forget();
}

// Nothing of what was shown is of the match that the model has now.
function forget() {
    sample = null;
    searches = new Map();
    stage.forget();
    untold = dirty = true;
}

function showHeader(matchId, mapName) {
    find('match-name').textContent = matchId;
    find('map-name').textContent = mapName;
    document.title = `${matchId} · Camera director`;
}

function showMatch(note) {
    if (isRecorded()) model.setMatch(note);
    stage.setScale(note.metres_per_unit);
    stage.setLooks(slot => ({...look(slot), label: look(slot).name}));
    showHeader(note.match_id, note.map);
    map.load(note.map);
    dirty = true;
}

// To screen readers, now.
function announce(text) {
    setText('announcement', text);
}

function notice(text) {
    announce(text);
    find('notice').textContent = text;
    find('notice').hidden = false;
    clearTimeout(noticeTimer);
    noticeTimer = setTimeout(() => { find('notice').hidden = true; }, noticeMs);
}

function showMessage(text, asksForToken = false) {
    if (find('message-text').textContent !== text) announce(text);
    find('message').hidden = text === '';
    find('message-text').textContent = text;
    find('token-form').hidden = !asksForToken;
}

async function refreshList() {
    try {
        matches = await findMatches();
        followLink();
        chooseMatch();
        showMessage(matches.length > 0 || isInTouch() ? '' : server.broadcastOfAddress === null
            ? 'No match is running. This page shows one as soon as it begins.'
            : 'Nothing is broadcast. This page shows a match as soon as one is.');
        if (model.note) map.load(model.note.map);
    } catch (error) {
        source?.unreachable?.();
        if (error instanceof Refused && error.status === 401) {
            showMessage('This server asks for a token.', true);
        } else {
            if (!source) showMessage(error instanceof Refused ? `There is nothing to watch: ${error.message}.`
                : 'The server cannot be reached. Trying again.');
        }
    }
    dirty = true;
    setTimeout(refreshList, listPeriodMs);
}

// A stream that runs, or a recording.
const isInTouch = () => isRecorded() || source?.connection === 'open' && !source.ended;

function followLink() {
    if (!matches.some(({id}) => id === linked)) return;
    if (linked !== watched?.id) watch(linked);
    linked = null;
}

function chooseMatch() {
    const entry = matches.find(other => other.id === watched?.id);
    if (entry) watched = entry;
    missed = entry?.stream ? 0 : missed + 1;
    runsSince = entry?.stream?.state === 'running' ? runsSince ?? now() : null;
    // What begins to run is seen a delay later.
    if (runsSince !== null && now() - runsSince > silenceMs + delayMs()) source?.runs?.();
    const next = choose(matches, {id: watched?.id ?? null, isRecorded: isRecorded(), hasEnded: source?.state === 'ended',
        isOpen: isInTouch(), missed, refusals: source?.refusals ?? 0});
    if (next?.from === 'broadcast') watchBroadcast(); else if (next) watch(next.id);
}

// Where a stream has no room for more, the broadcast has: what is shown goes on there.
function watchBroadcast() {
    const {buffer, clock} = model;
    const {paused} = clock;
    watch(watched.id, clock.live || clock.t === null || buffer.last === null ? {} : {behind: buffer.last - clock.t});
    model.clock.setPaused(paused);
    fullUntil = now() + fullForMs;
}

// What the viewer looks at on purpose is not left for the match of a link.
function stayHere() {
    if (watched) linked = null;
}

function chooseCamera(id) {
    stayHere();
    camera = wished = id;
    dirty = true;
}

// What the viewer has chosen, as soon as it is there; until then any.
function findCamera() {
    if (sample?.cameras.has(wished)) camera = wished;
    else if (!shownCamera()) camera = shownCameras()[0]?.id ?? camera;
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
    quality?.restart();
}

function setPictures(shown) {
    pictures = shown;
    find('pictures-toggle').setAttribute('aria-pressed', shown);
    dirty = true;
}

function stepCamera(by) {
    const ids = shownCameras().map(shot => shot.id);
    if (ids.length > 0) chooseCamera(ids[(ids.indexOf(camera) + by + ids.length) % ids.length]);
}

// What is older than the stream's minutes is in the recording.
function seek(t) {
    if (!source?.range) return;
    stayHere();
    const [first, last] = source.range;
    const {paused} = model.clock;
    if (!isRecorded() && watched.sync && t < first - 1) watch(watched.id, {behind: last - t}); else source.seek(t);
    model.clock.setPaused(paused);
    untold = dirty = true;
}

// From what is shown, once something is.
function step(ms) {
    if (model.clock.t !== null) seek(model.clock.t + ms);
}

function goToBegin() {
    stayHere();
    if (!isRecorded() && watched?.sync) watch(watched.id, {t: 0}); else if (source?.range) seek(source.range[0]);
}

function stepCut(by) {
    const {clock, timeline} = model;
    if (clock.t === null) return;
    // Where no camera is on, to the next that is.
    const next = by < 0 ? timeline.cutBefore(camera, clock.t - 1000) : shownCamera() ? timeline.cutAfter(camera, clock.t + 1)
        : timeline.cuts.find(({t}) => t > clock.t + 1);
    if (next) seek(next.t);
}

function setPaused(paused) {
    stayHere();
    if (!paused && isRecorded() && source.state === 'ended') seek(source.range[0]);
    model.clock.setPaused(paused);
    dirty = true;
}

const speeds = [0.25, 0.5, 1, 2, 4, 8];

function setSpeed(speed) {
    stayHere();
    model.clock.setSpeed(speed);
    dirty = true;
}

function stepSpeed(by) {
    const next = speeds[speeds.indexOf(model.clock.speed) + by];
    if (next) setSpeed(next);
}

const canGoLive = () => Boolean(watched?.stream || source?.isLive);

function goLive() {
    if (isRecorded() && watched.stream && now() >= fullUntil) watch(watched.id);
    else if (canGoLive()) source.goLive();
    else if (source?.range) seek(source.range[1]);
    untold = dirty = true;
}

function shownCameras() {
    return sample ? [...sample.cameras.values()].sort((a, b) => (a.target ?? 256) - (b.target ?? 256) || a.id - b.id) : [];
}

// Whether something can be drawn through a camera.
function shownCamera() {
    return sample?.cameras.get(camera) ?? null;
}

// Of the match that is watched.
const delayMs = () => isRecorded() ? source.sync?.delayMs ?? 0 : (watched?.stream?.delay_s ?? 0) * 1000;

// What the words of the state need to know.
function facts() {
    const {clock, buffer, note} = model;
    const entry = matches.find(other => other.id === watched?.id);
    const behindMs = isRecorded() ? source.isLive && source.range ? source.newest() - clock.t : null : buffer.last - clock.t;
    const lateMs = isRecorded() ? behindMs === null ? null : behindMs + delayMs()
        : behindMs + (source?.age ?? delayMs());
    return {retryInMs: (source?.retryAt ?? 0) - now(), known: note !== null, isFull: isFull(entry, source?.refusals ?? 0),
        entry: entry?.stream?.state, behindMs, lateMs};
}

function shownTime() {
    const {t} = model.clock;
    if (t === null) return '';
    if (!isRecorded() || !source.range) return clockText(t);
    const [first, last] = source.range;
    return `${clockText(t - first)} / ${clockText(last - first, false)}`;
}

function setText(id, text) {
    if (find(id).textContent !== text) find(id).textContent = text;
}

function showState() {
    const {clock} = model;
    const [state, text] = stateText(source?.state ?? 'none', facts());
    const element = find('state');
    if (element.dataset.state !== state) {
        element.dataset.state = state;
        announce(text);  // not with every tenth of a second
    }
    const label = element.querySelector('span');
    if (label.textContent !== text) label.textContent = text;
    find('live').hidden = source !== null && !canGoLive();
    find('live').setAttribute('aria-pressed', state === 'live');
    find('begin').hidden = !isRecorded() && !watched?.sync;
    const playing = !clock.paused;
    if (find('play').dataset.playing !== String(playing)) {
        find('play').dataset.playing = playing;
        find('play').setAttribute('aria-label', playing ? 'Pause' : 'Play');
        find('play').querySelector('path').setAttribute('d', playing ? 'M4 2h3v12H4zM9 2h3v12H9z' : 'M4 2l9 6-9 6z');
    }
    if (clock.speed !== toldSpeed) find('speed').value = toldSpeed = clock.speed;
    setText('clock', shownTime());
}

function showCaption() {
    const shot = shownCamera();
    const name = find('caption-name');
    const state = find('caption-state');
    name.hidden = state.hidden = !shot;
    if (!shot) return;
    const {name: text, colour} = lookOfShot(shot);
    setText('caption-name', text);
    if (name.dataset.colour !== colour) name.style.borderColor = name.dataset.colour = colour;
    const mode = modeOf(shot);
    const cut = model.timeline.cutBefore(camera, model.clock.t);
    const fresh = cut && model.clock.t - cut.t < 2500 ? ` · cut: ${reasonText(cut, slot => look(slot).name)}` : '';
    state.dataset.mode = mode;
    setText('caption-state', textOfShot(shot) + fresh);
}

function showLists() {
    const shots = matches.find(other => other.id === watched?.id)?.stream?.shots ?? [];
    const profiles = new Map(shots.map(shot =>
        [shot.camera_id, shot.automatic ? `the director chooses, ${shot.profile}` : shot.profile]));
    shotRows.show(shownCameras().map(shot =>
        shotEntry(shot, lookOfShot(shot), groupOf(shot.id).length > 0, profiles.get(shot.id) ?? '', shot.id === camera, () => chooseCamera(shot.id))),
    isRecorded() ? 'No camera was on. “Cut ›” goes to where one was.' : 'No camera is on: no spectator has asked for one.');
    matchRows.show(matches.map(({id, map, stream, goesOn}) => ({
        key: `match ${id}`, number: stream ? String(stream.players.length) : '▸', colour: '#c4ccd6', name: id,
        detail: `${map}, ${stream?.state ?? (goesOn ? 'broadcast' : 'recorded')}`, pressed: id === watched?.id,
        choose: () => {
            server.rememberMatch(id);
            linked = null;
            watch(id);
        },
    })), 'No match is running.');
}

// Buttons over the small pictures, as many as are shown.
function pictureShots() {
    if (!pictures || view !== 'camera' && !shownCamera()) return [];
    return shownCameras().filter(shot => view !== 'camera' || shot.id !== camera).slice(0, maxPictures);
}

// Lays a button over each small picture. Returns where on the stage they are: fewer, where the window is too small for all.
function layPictures(shots) {
    const looks = shots.map(lookOfShot);
    const key = [view, resize.last, ...shots.map(({id}, i) => `${id} ${looks[i].name} ${looks[i].colour}`)].join('\n');
    if (layPictures.last === key) return layPictures.places;
    layPictures.last = key;
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
        button.firstChild.textContent = looks[i].name;
        button.firstChild.style.color = looks[i].colour;
        button.onclick = () => { chooseCamera(shot.id); setView('camera'); };
    });
    const origin = find('stage').getBoundingClientRect();
    layPictures.places = [...holder.children].map(button => button.getBoundingClientRect()).filter(({width}) => width > 0)
        .map(({left, top, width, height}) => ({x: left - origin.left, y: top - origin.top, width, height}));
    return layPictures.places;
}

const level = () => levels[quality.level];
const screenRatio = () => Math.min(devicePixelRatio, 2);
const screenPixels = () => find('stage').clientWidth * find('stage').clientHeight * screenRatio() ** 2;

function resize() {
    const {clientWidth, clientHeight} = find('stage');
    const scale = scaleOf(level(), screenPixels());
    const size = `${clientWidth} ${clientHeight} ${screenRatio()}`;
    const drawn = `${size} ${quality.level} ${quality.reserve}`;
    if (drawn === resize.drawn || clientWidth === 0) return;
    if (size !== resize.size) quality.restart();
    Object.assign(resize, {size, drawn});
    stage.resize(clientWidth, clientHeight, screenRatio() * scale * quality.reserve);
    stage.map.setEdges(level().edges ? scale : 0);
    find('quality-note').hidden = scale === 1;
    dirty = true;
}

function drawStage() {
    const shots = pictureShots();
    const places = layPictures(shots);
    const shot = shownCamera();
    if (sample) stage.show(sample, camera, searches);
    map.applyTools();
    if (view !== 'camera' && find('follow').checked && shot) {
        const followed = sample.players.get(shot.target);
        if (followed) viewpoint.centre.set(...followed.position);
    }
    const {smallEvery} = level();
    places.forEach((place, i) => stage.drawSmall(i, shots[i], place, !smallEvery || framesDrawn % (smallEvery * places.length) === smallEvery * i));
    if (view === 'camera' && shot) stage.drawThrough(shot);
    else if (view === 'plan') stage.drawPlan(viewpoint);
    else stage.drawOrbit(viewpoint);
    places.forEach((place, i) => stage.pasteSmall(i, place));
    ++framesDrawn;
}

// Over the picture through a camera: where the player is that it searches for.
function showSearch() {
    const shot = view === 'camera' ? shownCamera() : null;
    const searched = shot && searches.get(shot.id);
    if (!searched) return searchMark.hide();
    const {clientWidth: width, clientHeight: height} = find('stage');
    searchMark.show(shot, searched, lookOfShot(shot).colour, {width, height});
}

// To screen readers, which read it out when it changes: while the timeline has the focus only after a step.
function tellTime() {
    const {clock} = model;
    untold = false;
    const [first, last] = source.range;
    const element = find('timeline');
    element.setAttribute('aria-valuemin', Math.round(first));
    element.setAttribute('aria-valuemax', Math.round(last));
    element.setAttribute('aria-valuenow', Math.round(clock.t));
    const time = isRecorded() ? shownTime() : `${seconds(last - clock.t)} before the newest frame`;
    element.setAttribute('aria-valuetext', [time, ...latencyWords(clock.t)].join(', '));
}

function clearTimeline() {
    timelineView.clear();
    const element = find('timeline');
    for (const name of ['aria-valuemin', 'aria-valuemax', 'aria-valuenow']) element.setAttribute(name, 0);
    element.removeAttribute('aria-valuetext');
}

function drawTimeline() {
    const {clock, timeline} = model;
    if (!source?.range || clock.t === null) return clearTimeline();
    const [first, last] = source.range;
    if (document.activeElement !== find('timeline') || untold) tellTime();
    timelineView.draw({timeline, camera, t: clock.t, first, last, whole: isRecorded(), delayMs: delayMs(),
        colourOfSlot: slot => look(slot).colour});
}

let lastPanel = 0;
function frame(at) {
    requestAnimationFrame(frame);  // what fails below may go well in the next picture
    const shownBefore = model.clock.t;
    source?.advance(now());
    resize();
    const draws = model.clock.t !== shownBefore || dirty;
    if (draws) {
        dirty = false;
        sample = source?.state === 'loading' ? sample : model.sample() ?? sample;
        if (sample) searches = searchesOf(sample, id => groupOf(id).length > 0);
        findCamera();
        drawStage();
        showSearch();
        showCaption();
        feed.show(model.timeline.events, model.clock.t ?? 0);
    }
    quality.frame(at, draws);
    if (at - lastPanel > 120) {
        drawRate = (framesDrawn - framesCounted) * 1000 / (at - lastPanel) * 0.2 + drawRate * 0.8;
        framesCounted = framesDrawn;
        lastPanel = at;
        showState();
        showLists();
        drawTimeline();
    }
}

const keys = {
    '1': () => setView('camera'),
    '2': () => setView('orbit'),
    '3': () => setView('plan'),
    n: () => stepCamera(1),
    p: () => stepCamera(-1),
    ' ': () => setPaused(!model.clock.paused),
    j: () => step(-stepMs),
    k: () => step(stepMs),
    b: goToBegin,
    '<': () => stepSpeed(-1),
    '>': () => stepSpeed(1),
    '[': () => stepCut(-1),
    ']': () => stepCut(1),
    l: goLive,
    f: () => find('follow').click(),
    m: () => find('mesh').click(),
    i: () => setPictures(!pictures),
    c: () => moveCut(-0.05),
    C: () => moveCut(0.05),
    '?': () => find('help').showModal(),
};

function moveCut(by) {
    find('cut').value = Number(find('cut').value) + by;
}

document.addEventListener('keydown', event => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (find('help').open) return event.key === '?' ? find('help').close() : undefined;
    const {target} = event;
    if (target.matches('input:not([type=checkbox]), select')) return;
    if (event.key === ' ' && target.matches('button, input')) return;  // presses it
    const handled = target === find('canvas') && view !== 'camera' && viewpoint.key(event, view === 'plan');
    const action = handled ? () => {} : keys[event.key] ?? (event.shiftKey ? undefined : keys[event.key.toLowerCase()]);
    if (!action) return;
    event.preventDefault();
    action();
    dirty = true;
});

attachScrubbing(find('timeline'), find('tip'), {
    range: () => source?.range ?? null,
    axis: () => source,
    now: () => model.clock.t,
    timeAt: clientX => timelineView.timeAt(clientX, ...source.range, isRecorded()),
    describe: describeTime,
    seek,
    goToBegin,
    goLive,
});

// Of the frame that was shown then, where it is known.
function latencyWords(t) {
    const latency = model.timeline.latencyAt(t);
    return latency === null ? [] : [latencyText(latency, delayMs())];
}

// Where the shown camera was, as far as frames are kept.
function placeAt(t) {
    const {buffer} = model;
    return t >= buffer.first && t <= buffer.last ? buffer.sample(t)?.cameras.get(camera)?.position : null;
}

// What the shot did at a time, and the nearest cut.
function describeTime(t) {
    const [first, last] = source.range;
    const span = model.timeline.spans(camera, t, t + 1).map(state => ({...state, id: camera, position: placeAt(t)}))[0];
    const near = model.cutNear(camera, t, 0.005 * Math.max(last - first, 300e3));
    const parts = [isRecorded() ? clockText(t - first) : `−${seconds(last - t)}`];
    if (span) parts.push(`${lookOfShot(span).name}: ${textOfShot(span).toLowerCase()}`);
    parts.push(...latencyWords(t));
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
find('pictures-toggle').addEventListener('click', keys.i);
find('cut-before').addEventListener('click', keys['[']);
find('cut-after').addEventListener('click', keys[']']);
find('back').addEventListener('click', keys.j);
find('ahead').addEventListener('click', keys.k);
find('play').addEventListener('click', keys[' ']);
find('live').addEventListener('click', goLive);
find('begin').addEventListener('click', goToBegin);
find('speed').addEventListener('change', () => {
    setSpeed(Number(find('speed').value));
    toldSpeed = null;
});
for (const id of ['cut', 'mesh', 'follow']) find(id).addEventListener('input', () => { dirty = true; });
find('token-form').addEventListener('submit', event => {
    event.preventDefault();
    server.setToken(find('token').value);
    showMessage('Opening');
});
document.addEventListener('visibilitychange', () => { dirty = true; });
// The link's address would take the place of the match's.
document.querySelector('.skip').addEventListener('click', event => {
    event.preventDefault();
    find('timeline').focus();
});
server.followAddress(() => {
    if (!find('token-form').hidden) showMessage('Opening');
    linked = server.matchOfAddress;
    followLink();
});
addEventListener('error', ({message}) => {
    if (message) notice(`This page has failed: ${message}`);
});

// For tests and for whoever is curious: what is drawn.
window.cameraDirector = {
    redraw: drawStage,  // the canvas keeps its picture only until the browser has shown it
    state: () => ({
        connection: source?.connection ?? 'none', state: find('state').dataset.state, match: model.note?.match_id ?? null,
        map: model.note?.map ?? null, view, camera, time: model.clock.t, shown: sample?.t ?? null, range: source?.range ?? null,
        first: source?.range?.[0] ?? null, last: source?.range?.[1] ?? null, live: model.clock.live, paused: model.clock.paused,
        speed: model.clock.speed, recorded: isRecorded(), problems: source?.problems ?? [], frames: model.buffer.frames.length,
        dropped: source?.dropped ?? 0, drawRate, age: source?.age ?? null,
        players: sample ? [...sample.players.values()].map(player => ({...player, id: model.players.get(player.slot)?.id,
            name: nameOf(model.players.get(player.slot))})) : [],
        cameras: shownCameras().map(shot => ({...shot, target: model.players.get(shot.target)?.id ?? null})),
        movers: stage?.movers.drawn ?? [],
        cuts: model.timeline.cuts.length, events: model.timeline.events.length,
        obstacles: Boolean(stage?.map.hasObstacles), mesh: Boolean(stage?.map.mesh), note: map?.note ?? '', quality: quality?.level ?? null,
    }),
};

try {
    stage = new Stage(find('canvas'));
    map = new ShownMap(stage, viewpoint, () => {
        dirty = true;
        quality?.restart();
    });
    find('canvas').addEventListener('webglcontextrestored', () => { dirty = true; });
    quality = new Quality(stage.hasCard ? 0 : levelOfProcessor(screenPixels()), stage.hasCard);
    attach(find('canvas'), viewpoint, {
        active: () => view !== 'camera' || !shownCamera(),
        isPlan: () => view === 'plan',
        changed: () => { dirty = true; },
    });
    setView('camera');
    setPictures(pictures);
    refreshList();
    requestAnimationFrame(frame);
} catch (error) {
    showMessage(`This page needs WebGL: ${error.message}`);
}
