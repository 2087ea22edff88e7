// What a browser shows of the recording that window_test.mjs leaves: playback_test.mjs BIN_DIR FOLDER DOMAIN.
import assert from 'node:assert/strict';
import {spawnSync} from 'node:child_process';
import {cpSync, existsSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync} from 'node:fs';
import {Broadcast} from '../../../server/page/broadcast.js';
import {Roster, readFragment, readState} from '../../../server/page/fragment.js';
import {FrameBuffer} from '../../../server/page/playout.js';
import {Browser} from './browser.mjs';
import {Programs, colours, eventually, isInHall, run, stop} from './stage.mjs';

const [bin, folder, domain] = process.argv.slice(2);
const programs = new Programs(bin);
const port = 20000 + Number(domain) * 100;
const url = `http://127.0.0.1:${port}`;

// A recording of some fragments.
function findRecording() {
    const all = readdirSync(`${folder}/recordings`).map(name => `${folder}/recordings/${name}`).filter(path => existsSync(`${path}/sync`));
    const lastOf = path => JSON.parse(readFileSync(`${path}/sync`, 'utf8')).last_fragment;
    return {path: all.sort((a, b) => lastOf(b) - lastOf(a))[0], last: Math.max(...all.map(lastOf))};
}

function play(path, ...options) {
    return programs.start('camera-director', 'play', path, '--http', `127.0.0.1:${port}`, ...options);
}

const ready = child => eventually('the link', () => child.log.includes(`watch it, until Ctrl-C, at ${url}/`));

// What the server has of the recording, in frames and cuts.
async function fetchAll() {
    const [{sync}] = (await (await fetch(`${url}/broadcast`)).json()).matches;
    const broadcast = new Broadcast(url + sync, fetch);
    const {first, last} = await broadcast.sync();
    const frames = new FrameBuffer(Infinity);
    const roster = new Roster();
    let cuts = 0;
    let {beginTime: origin, state} = await readState(await broadcast.fragment(first, 'full'), first);
    for (let n = first; n <= last; ++n) {
        const fragment = await readFragment(await broadcast.fragment(n, 'delta'), n, state, origin, roster);
        for (const frame of fragment.frames) frames.add(frame.t, 1, () => frame);
        cuts += fragment.cuts.length;
        ({state} = fragment);
    }
    return {frames, cuts};
}

// After a seek; the timeline has so many pixels.
const isAt = (state, t, [first, last]) => Math.abs(state.time - t) < Math.max(60, (last - first) / 400) && state.state === 'paused';

async function seek(browser, t, range) {
    const {left, width, top} = await browser.evaluate('(({left, width, top}) => ({left, width, top}))(document.getElementById("timeline").getBoundingClientRect())');
    const x = left + (t - range[0]) / (range[1] - range[0]) * width;
    for (const type of ['mousePressed', 'mouseReleased'])
        await browser.send('Input.dispatchMouseEvent', {type, x, y: top + 20, button: 'left', buttons: type === 'mousePressed' ? 1 : 0, clickCount: 1});
}

// Of another server at the same address: what the browser has kept of the one before, a second old, is not it.
async function openAnew(browser, address) {
    await browser.send('Network.clearBrowserCache');
    await browser.open('about:blank');
    await browser.open(`${address}/`);
}

const near = (a, b, limit) => a.forEach((value, i) => assert.ok(Math.abs(value - b[i]) < limit, `${a} is not ${b}`));

const tests = {
    async 'a recording is played from its begin, with its map'(browser, {last}) {
        await browser.until('window.cameraDirector?.state().cameras.length > 0');
        await browser.until('cameraDirector.state().obstacles && cameraDirector.state().mesh');
        const state = await browser.evaluate('cameraDirector.state()');
        assert.ok(state.recorded && state.time < 30e3 && state.match === 'walk-0' && state.map === 'hall');
        assert.equal(state.first, 0);
        assert.ok(state.last > (last - 1) * 3000 && state.last < (last + 2) * 3500, `${state.last}`);
        const before = state.time;
        await browser.until(`cameraDirector.state().time > ${before + 1000}`);
        assert.ok(await browser.evaluate(colours) > 20);
        assert.match(await browser.evaluate('document.getElementById("clock").textContent'), /^\d+:\d\d\.\d \/ \d+:\d\d$/);
    },
    async 'what is drawn after a seek is what the server has of that time'(browser) {
        const {frames, cuts} = await fetchAll();
        const {range} = await browser.evaluate('cameraDirector.state()');
        assert.ok(Math.abs(frames.last - range[1]) < 100, `${frames.last} ${range}`);
        await browser.press(' ', {code: 'Space'});
        await browser.until('cameraDirector.state().paused');
        for (const part of [0.9, 0.1, 0.5, 0.53]) {
            const t = range[0] + part * (range[1] - range[0]);
            await seek(browser, t, range);
            await eventually('the seek', async () => isAt(await browser.evaluate('cameraDirector.state()'), t, range));
            // Where the recording has a gap, as of a machine that stalled, that is the frame before it.
            const shown = await eventually('the picture', async () => {
                const state = await browser.evaluate('cameraDirector.state()');
                return Math.abs(state.shown - frames.sample(state.time).t) < 1e-6 && state;
            });
            const wanted = frames.sample(shown.time);
            assert.deepEqual(shown.players.map(({slot}) => slot), [...wanted.players.keys()]);
            for (const player of shown.players) {
                near(player.position, wanted.players.get(player.slot).position, 1e-6);
                assert.ok(isInHall(player));
            }
            assert.deepEqual(shown.cameras.map(({id}) => id).sort(), [...wanted.cameras.keys()].sort());
            for (const camera of shown.cameras) {
                near(camera.position, wanted.cameras.get(camera.id).position, 1e-6);
                near(camera.rotation, wanted.cameras.get(camera.id).rotation, 1e-6);
            }
        }
        await browser.until(`cameraDirector.state().cuts === ${cuts}`);
    },
    async 'it has speeds and keys, and ends'(browser) {
        await browser.press('b');
        await browser.until('cameraDirector.state().time === 0');
        for (let i = 0; i < 3; ++i) await browser.press('>');
        await browser.until('cameraDirector.state().speed === 8 && document.getElementById("speed").value === "8"');
        await browser.press(' ', {code: 'Space'});
        await browser.until(`document.getElementById('state').dataset.state === 'ended'`);
        await browser.press(' ', {code: 'Space'});
        await browser.until('!cameraDirector.state().paused && cameraDirector.state().time < 20000');
        assert.ok(await browser.evaluate('document.getElementById("live").hidden'), 'nothing is live');
    },
    async 'on a small phone nothing is cut off, and the small pictures leave the middle free'(browser) {
        await browser.resize({width: 360, height: 740, scale: 2, mobile: true});
        await browser.until('innerWidth === 360');
        assert.ok(await browser.evaluate('document.documentElement.scrollWidth') <= 360);
        await browser.evaluate(`document.getElementById('caption-state').textContent = 'In view · cut: the player respawned or was moved'`);
        const cutOff = 'return [...document.querySelectorAll("#caption span, .transport > *, #clock")].filter(e => e.scrollWidth > e.clientWidth + 1 && e.clientWidth > 0).map(e => e.id)';
        assert.deepEqual(await browser.evaluate(`(() => { ${cutOff} })()`), []);
        for (const width of [360, 1280]) {
            await browser.resize({width, height: 740});
            await browser.until(`innerWidth === ${width} && document.querySelector('#pictures button')`);
            const [left, middle] = await browser.evaluate(`(() => { const stage = document.getElementById('stage').getBoundingClientRect();
                return [document.querySelector('#pictures button').getBoundingClientRect().left, stage.left + stage.width / 2]; })()`);
            assert.ok(left > middle + 0.15 * width, `at ${width} the pictures begin at ${left}`);
        }
        await browser.resize({width: 1280, height: 800});
    },
    async 'without the baked map it says that there is none'(browser, stage) {
        await stop(stage.player);
        stage.player = play(stage.path);
        await ready(stage.player);
        assert.match(stage.player.log, /the map is not shown: name its baked file/);
        await browser.open('about:blank');
        await browser.open(`${url}/`);
        await browser.until('window.cameraDirector?.state().cameras.length > 0');
        assert.match(await browser.until('cameraDirector.state().note'), /This map cannot be shown: no map of this name is loaded/);
        assert.ok(await browser.evaluate(colours) > 3, 'players are drawn');
    },
    async 'what is broken is told, and left out'(browser, stage) {
        await stop(stage.player);
        const broken = `${folder}/broken`;
        cpSync(stage.path, broken, {recursive: true});
        const delta = n => `${broken}/${n}/delta`;
        const whole = readFileSync(delta(1));
        whole[whole.length >> 1] ^= 1;
        writeFileSync(delta(1), whole);
        rmSync(`${broken}/2`, {recursive: true});
        stage.player = play(broken);
        await ready(stage.player);
        await openAnew(browser, url);
        await browser.until('window.cameraDirector?.state().problems.length >= 2');
        const {problems, last} = await browser.evaluate('cameraDirector.state()');
        assert.match(problems[0], /^Damaged, left out: fragment 1, delta: byte 28: the checksum differs/);
        assert.match(problems[1], /^Missing, left out: fragment 2, full: the server answers with 404/);
        await browser.until('!document.getElementById("notice").hidden');
        await browser.until(`cameraDirector.state().time > ${Math.min(10e3, last - 500)} && cameraDirector.state().players.length > 0`);
    },
    async 'behind a cache the page needs no stream, and follows the broadcast'(browser, stage) {
        const nginx = ['/usr/sbin/nginx', '/usr/bin/nginx'].find(existsSync);
        if (!nginx) return console.log('skipped: needs the package nginx-light');
        await stop(stage.player);
        stage.player = play(stage.path, '--live', '--from', '1', '--speed', '0.5');  // more time than 12 s
        await ready(stage.player);
        const cache = `${folder}/nginx`;
        mkdirSync(cache);
        const site = [[/^proxy_cache_path \S+/m, `proxy_cache_path ${cache}/site`], ['listen 80 default_server;', `listen 127.0.0.1:${port + 1};`],
            ['127.0.0.1:9464', `127.0.0.1:${port}`]].reduce((text, [from, to]) => {
            const here = text.replace(from, to);
            assert.notEqual(here, text, `nginx.conf has no ${from}`);
            return here;
        }, readFileSync(new URL('../../../deploy/broadcast/nginx.conf', import.meta.url), 'utf8'));
        const paths = ['client_body', 'proxy', 'fastcgi', 'uwsgi', 'scgi'].map(name => `${name}_temp_path ${cache}/${name};`).join(' ');
        writeFileSync(`${cache}/nginx.conf`, `pid ${cache}/pid; error_log stderr; daemon off; master_process off; events {}
            http { access_log off; ${paths} types { text/html html; } ${site} }`);
        const server = programs.start(nginx, '-p', cache, '-c', `${cache}/nginx.conf`);
        const public_ = `http://127.0.0.1:${port + 1}`;
        await eventually('nginx', () => fetch(`${public_}/broadcast`).then(answer => answer.ok)).catch(error => {
            throw new Error(`${error.message}: ${server.log}`);
        });
        assert.equal((await fetch(`${public_}/status`)).status, 404);
        assert.equal((await fetch(`${public_}/live`)).status, 404);
        assert.equal((await fetch(`${public_}/broadcast`)).headers.get('access-control-allow-origin'), '*');
        browser.events.length = 0;
        await openAnew(browser, public_);
        await browser.until(`window.cameraDirector?.state().state === 'live' && cameraDirector.state().players.length > 0`);
        assert.equal(await browser.evaluate('location.search'), '?broadcast=/broadcast');
        const before = await browser.evaluate('cameraDirector.state().time');
        await browser.until(`cameraDirector.state().time > ${before + 3500}`);
        assert.ok(await browser.evaluate('cameraDirector.state().recorded && !document.getElementById("live").hidden'));
        assert.match(await browser.evaluate('document.querySelector("#state span").textContent'), /^Live · \d+\.\d s after the game$/);
        const asked = browser.events.filter(({method}) => method === 'Network.requestWillBeSent').map(({params}) => params.request.url);
        assert.deepEqual(browser.events.filter(({method}) => method === 'Network.webSocketCreated'), []);
        assert.ok(asked.some(path => path.endsWith('/delta')) && asked.every(path => path.startsWith(public_) || path === 'about:blank'), `${asked}`);
        await browser.press('b');
        await browser.until('cameraDirector.state().time < 10000 && cameraDirector.state().players.length > 0');
        await browser.press('l');
        await browser.until(`['live', 'ended'].includes(cameraDirector.state().state) && cameraDirector.state().time > 5000`);
    },
    async 'the page complained of nothing'(browser) {
        assert.deepEqual(browser.complaints().filter(text => !/ERR_CONNECTION|404/.test(text)), []);
    },
};

async function main() {
    const recording = findRecording();
    assert.ok(recording.last >= 3, `${recording.last} fragments`);
    const nothing = spawnSync(`${bin}/camera-director`, ['play', folder], {encoding: 'utf8'});
    assert.equal(nothing.status, 1);
    const stage = {...recording, player: play(recording.path, `${folder}/hall.vfs`, '--map', `${folder}/hall.obj`)};
    await ready(stage.player);
    const browser = await Browser.start();
    let failed;
    try {
        await browser.open(`${url}/`);
        failed = await run(tests, browser, stage);
    } finally {
        browser.close();
    }
    if (failed > 0) console.log(programs.logs());
    process.exitCode = failed > 0 ? 1 : 0;
}

try {
    await main();
} catch (error) {
    console.log(error.stack, programs.logs());
    process.exitCode = 1;
} finally {
    programs.kill();
}
