// What a browser shows of a real match of players that walk through a hall: window_test.mjs BIN_DIR FOLDER DOMAIN.
import assert from 'node:assert/strict';
import {spawnSync} from 'node:child_process';
import {writeFileSync} from 'node:fs';
import {levels, scaleOf} from '../../../server/page/quality.js';
import {Browser} from './browser.mjs';
import {Programs, colours, eventually, hall, isInHall, run, stop} from './stage.mjs';

const [bin, folder, domain] = process.argv.slice(2);
const port = 20000 + Number(domain) * 100;  // a domain is this test's alone
const url = `http://127.0.0.1:${port}`;
const programs = new Programs(bin);
const players = 3;
const secret = 'a/b+c==';

const json = path => fetch(url + path).then(answer => answer.json());

function serve({source = true, token = false, records = false} = {}) {
    const map = {name: 'hall', file: 'hall.vfs', ...(source ? {source: 'hall.obj', up: 'z'} : {})};
    const http = {port, ...(token ? {address: '0.0.0.0', token_file: 'token'} : {})};
    writeFileSync(`${folder}/token`, `${secret}\n`, {mode: 0o600});
    writeFileSync(`${folder}/config.json`, JSON.stringify({dds: {domain: Number(domain)}, http, maps: [map],
        ...(records ? {recording: {folder: 'recordings'}} : {})}));
    return programs.start('camera-director', 'serve', '--config', `${folder}/config.json`);
}

const tests = {
    async 'the page draws what /live and /status say'(browser) {
        await browser.until(`cameraDirector.state().cameras.length === ${players}`);
        const state = await browser.until('cameraDirector.state().obstacles && cameraDirector.state()');
        const [live, status] = await Promise.all([json('/live'), json('/status')]);
        const [match] = live.matches;
        assert.equal(state.match, match.match_id);
        assert.equal(state.map, 'hall');
        assert.deepEqual(state.players.map(player => player.id).sort(), match.players.map(player => player.id).sort());
        assert.deepEqual(state.cameras.map(({id, target}) => [id, target]).sort(),
            status.matches[0].shots.map(shot => [shot.camera_id, shot.target.id]).sort());
        for (const shown of [...state.players, ...state.cameras]) assert.ok(isInHall(shown), `${shown.position} is not in the hall`);
        assert.equal(await browser.evaluate('document.querySelectorAll("#shots button").length'), players);
        assert.equal(await browser.evaluate('document.querySelectorAll("#matches button").length'), 1);
        const metrics = await fetch(`${url}/metrics`).then(answer => answer.text());
        assert.match(metrics, /^camera_director_live_viewers 1$/m);
        assert.match(metrics, /^camera_director_matches_led 1$/m);
        assert.match(metrics, /^camera_director_reception_seconds_count [1-9]/m);
        for (const stage of ['waiting', 'computing', 'writing'])
            assert.match(metrics, new RegExp(`^camera_director_stage_seconds_count\\{stage="${stage}"\\} [1-9]`, 'm'));
    },
    async 'the picture is not empty'(browser) {
        for (const view of ['orbit', 'plan', 'camera']) {
            await browser.evaluate(`document.querySelector('[data-view=${view}]').click()`);
            await browser.until(`cameraDirector.state().view === '${view}'`);
            const found = await browser.evaluate(colours);
            assert.ok(found > 20, `${view} has ${found} colours`);
        }
    },
    async 'it is drawn as finely as its quality says, and a note says where the screen has more'(browser) {
        await eventually('the quality', async () => {
            const [quality, drawn, width, height, isNoted] = await browser.evaluate(`(({width, clientWidth, clientHeight}) =>
                [cameraDirector.state().quality, width, clientWidth, clientHeight, !document.getElementById('quality-note').hidden])
                (document.getElementById('canvas'))`);
            const scale = scaleOf(levels[quality], width * height);
            return drawn === Math.floor(width * scale) && isNoted === scale < 1;
        });
    },
    async 'it moves with the match, pauses, goes back and comes back'(browser) {
        const time = () => browser.evaluate('cameraDirector.state().time');
        const before = await time();
        await browser.until(`cameraDirector.state().time > ${before + 2000}`);
        await browser.press(' ', {code: 'Space'});
        await browser.until('cameraDirector.state().paused');
        const paused = await time();
        await browser.press('j');
        await browser.until(`cameraDirector.state().time < ${paused}`);
        await browser.until('document.getElementById("state").dataset.state === "paused"');
        await browser.press('l');
        await browser.until(`cameraDirector.state().live && cameraDirector.state().time > ${paused}`);
        await browser.press(' ', {code: 'Space'});
        await browser.evaluate('document.getElementById("timeline").focus()');
        await browser.press('End');
        await browser.until('cameraDirector.state().live');
    },
    async 'what is recorded is watched from its begin, and live again'(browser) {
        await browser.until('document.getElementById("live").ariaPressed === "true"');
        await browser.until('!document.getElementById("begin").hidden');
        await browser.press('Home');
        await browser.until('cameraDirector.state().recorded && cameraDirector.state().time !== null');
        assert.ok(await browser.evaluate('cameraDirector.state().time') < 5000);
        await browser.until(`cameraDirector.state().state === 'behind' && cameraDirector.state().cameras.length > 0`);
        const state = await browser.evaluate('cameraDirector.state()');
        assert.deepEqual(state.problems, []);
        for (const shown of [...state.players, ...state.cameras]) assert.ok(isInHall(shown), `${shown.position} is not in the hall`);
        await browser.until('document.getElementById("live").ariaPressed === "false"');
        await browser.press('l');
        await browser.until('!cameraDirector.state().recorded && cameraDirector.state().live');
        await browser.until(`document.getElementById('state').dataset.state === 'live'`);
        await browser.press('j');
        await browser.until('!cameraDirector.state().live');
        await browser.evaluate('document.getElementById("timeline").focus()');
        await eventually('what is older than the stream', async () => {
            await browser.press('PageDown');
            return browser.evaluate('cameraDirector.state().recorded');
        });
        await browser.press('End');
        await browser.until(`!cameraDirector.state().recorded && cameraDirector.state().live && cameraDirector.state().cameras.length === ${players}`);
    },
    async 'keys choose views and cameras'(browser) {
        for (const [key, view] of [['2', 'orbit'], ['3', 'plan'], ['1', 'camera']]) {
            await browser.press(key);
            await browser.until(`cameraDirector.state().view === '${view}'`);
        }
        const first = await browser.evaluate('cameraDirector.state().camera');
        await browser.press('n');
        await browser.until(`cameraDirector.state().camera !== ${first}`);
        await browser.press('p');
        await browser.until(`cameraDirector.state().camera === ${first}`);
        await browser.press('?', {shift: true});
        await browser.until('document.getElementById("help").open');
        await browser.press('Escape');
        await browser.until('!document.getElementById("help").open');
    },
    async 'the tabulator reaches every control, and the focus is seen'(browser) {
        await browser.evaluate('document.querySelector("[data-view=plan]").click(); document.activeElement.blur()');
        const mark = `[...document.querySelectorAll('button, input, select, [tabindex="0"], a')]
            .filter(e => e.checkVisibility() && e.tabIndex >= 0 && !e.closest('dialog'))`;
        const wanted = await browser.evaluate(`${mark}.map((e, i) => e.dataset.probe = String(i))`);
        const reached = new Set();
        for (let i = 0; i < 3 * wanted.length && reached.size < wanted.length; ++i) {
            await browser.press('Tab');
            const [probe, outline] = await browser.evaluate(
                '[document.activeElement.dataset.probe ?? "", getComputedStyle(document.activeElement).outlineStyle]');
            if (probe === '') continue;
            reached.add(probe);
            assert.notEqual(outline, 'none', `the focus of control ${probe} is not seen`);
        }
        assert.deepEqual([...reached].sort(), wanted.slice().sort());
        await browser.evaluate('document.querySelector("[data-view=camera]").click()');
    },
    async 'a door is drawn where it is, live and from the recording'(browser) {
        const game = programs.start('example-game-server', '--match', 'door', '--map', 'hall', '--centre', '8,8,1.7', '--radius', '1',
            '--door', '2', '--domain', domain);
        const watch = async match => {
            const button = `[...document.querySelectorAll('#matches button')].find(b => b.textContent.includes('${match}'))`;
            await browser.until(`Boolean(${button})`);
            await browser.evaluate(`${button}.click()`);
            await browser.until(`cameraDirector.state().match === '${match}'`);
        };
        await watch('door');
        const height = () => browser.evaluate('cameraDirector.state().movers[0]?.position[2] ?? null');
        const isOnItsWay = z => z > 1.6 && z < 130;
        const moves = async () => {
            const before = await browser.until('cameraDirector.state().movers.length === 1 && cameraDirector.state().movers[0].position[2]');
            assert.ok(isOnItsWay(before), `${before}`);
            await eventually('movement', async () => Math.abs(await height() - before) > 1);
        };
        await moves();
        assert.equal(await browser.evaluate('cameraDirector.state().movers[0].corners'), 6 * 6 + 6 * 8, 'triangles and edges of a box');
        // As soon as the list of matches has its recording.
        await eventually('the recording', async () => {
            await browser.press('Home');
            return browser.evaluate('cameraDirector.state().recorded');
        });
        await browser.until('cameraDirector.state().time !== null');
        await moves();
        await stop(game);
        await watch('walk-0');
        await browser.until(`cameraDirector.state().live && cameraDirector.state().cameras.length === ${players}`);
    },
    async 'a link to a match that begins later leads there once it has begun, unless the viewer looks at another on purpose'(browser) {
        const begin = match => programs.start('example-game-server', '--match', match, '--map', 'hall', '--centre', '8,8,1.7',
            '--radius', '1', '--domain', domain);
        const open = async match => {
            await browser.open('about:blank');
            await browser.open(`${url}/#match=${match}`);
            await browser.until(`window.cameraDirector?.state().match === 'walk-0'`);
        };
        await open('later');
        const later = begin('later');
        await browser.until(`cameraDirector.state().match === 'later'`);
        await stop(later);
        await open('latest');
        const button = match => `[...document.querySelectorAll('#matches button')].find(b => b.textContent.includes('${match}'))`;
        await browser.press(' ', {code: 'Space'});
        await browser.until('cameraDirector.state().paused');
        const latest = begin('latest');
        await browser.until(`Boolean(${button('latest')})`);
        assert.equal(await browser.evaluate('cameraDirector.state().match'), 'walk-0');
        await stop(latest);
        await browser.press('l');
        await browser.until(`cameraDirector.state().live && cameraDirector.state().cameras.length === ${players}`);
    },
    async 'nothing is wider than a small phone'(browser) {
        await browser.resize({width: 360, height: 740, scale: 2, mobile: true});
        await browser.until('innerWidth === 360');
        assert.ok(await browser.evaluate('document.documentElement.scrollWidth') <= 360);
        await browser.resize({width: 1280, height: 800});
    },
    async 'it comes back when the director does, and says when the map has no source'(browser, stage) {
        // Enough for playback_test.mjs.
        await eventually('four fragments', async () => (await json('/broadcast/walk%2D0/sync')).last_fragment >= 3);
        await stop(stage.director);
        await browser.until(`document.getElementById('notice').textContent === 'The server stops'`);
        await browser.until(`document.getElementById('state').dataset.state === 'waiting'`);
        stage.director = serve({source: false});
        await eventually('ready', () => fetch(`${url}/-/ready`).then(answer => answer.ok));
        const before = await browser.evaluate('cameraDirector.state().last');
        await browser.until(`cameraDirector.state().connection === 'open' && cameraDirector.state().last !== ${before} &&
            cameraDirector.state().cameras.length === ${players}`);
        await browser.open(`${url}/#match=walk-0`);
        await browser.send('Page.reload');
        await browser.until('window.cameraDirector?.state().mesh');
        assert.match(await browser.until('cameraDirector.state().note'), /no source of this map/);
        await browser.until('!document.getElementById("map-note").hidden');
    },
    async 'where a token is wanted the page asks for it, and takes it from the link'(browser, stage) {
        await stop(stage.director);
        stage.director = serve({token: true});
        await eventually('ready', () => fetch(`${url}/-/ready`).then(answer => answer.ok));
        await browser.until('!document.getElementById("token-form").hidden');
        await browser.evaluate(`document.getElementById('token').value = ${JSON.stringify(secret)};
            document.querySelector('#token-form button').click()`);
        await browser.until(`cameraDirector.state().connection === 'open'`);
        await browser.evaluate('sessionStorage.clear()');
        await browser.open('about:blank');
        await browser.open(`${url}/#token=${encodeURIComponent(secret)}&match=walk-0`);
        await browser.until(`window.cameraDirector?.state().cameras.length === ${players}`);
        await browser.until('location.hash === "#match=walk-0"');
    },
    async 'the page complained of nothing, and is small'(browser) {
        const complaints = browser.complaints().filter(text => !/ERR_CONNECTION|401|404|WebSocket/.test(text));
        assert.deepEqual(complaints, []);
        const bytes = browser.events.filter(({method}) => method === 'Network.loadingFinished')
            .reduce((sum, {params}) => sum + params.encodedDataLength, 0);
        assert.ok(bytes < 2e6, `${bytes} bytes were loaded`);
        console.log(`${bytes} bytes loaded, ${(await browser.evaluate('cameraDirector.state().drawRate')).toFixed(1)} frames/s`);
    },
};

async function main() {
    writeFileSync(`${folder}/hall.obj`, hall());
    const baked = spawnSync(`${bin}/camera-director`,
        ['bake', `${folder}/hall.obj`, '-o', `${folder}/hall.vfs`, '--up', 'z', '--quiet'], {encoding: 'utf8'});
    assert.equal(baked.status, 0, baked.stderr);
    const stage = {director: serve({records: true})};
    programs.start('synthetic-players', `${folder}/hall.vfs`, '--map-name', 'hall', '--players', String(players), '--match-prefix', 'walk',
        '--rate', '30', '--domain', domain);
    programs.start('observer-probe', '--domain', domain, '--match-prefix', 'walk', '--observers', String(players), '--grace', '600',
        '--max-gaps', '1000000', '--max-violations', '1000000');
    await eventually('cameras', () => json('/live').then(live => live.matches[0]?.shots.length === players));
    const browser = await Browser.start();
    let failed;
    try {
        await browser.open(`${url}/`);
        await browser.until('window.cameraDirector?.state().frames > 10');
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
