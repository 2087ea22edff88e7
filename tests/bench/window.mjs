// How fast the window draws, by Chromium's own measures: window.mjs BIN_DIR FOLDER DOMAIN PLAYERS CAMERAS SECONDS [PICTURES],
// as bench-window.sh calls it. FOLDER has config.json and the baked map.
import {writeFileSync} from 'node:fs';
import {Browser} from '../integration/window/browser.mjs';
import {Programs, eventually} from '../integration/window/stage.mjs';

const [bin, folder, domain, players, cameras, seconds, pictures] = process.argv.slice(2);
const url = `http://127.0.0.1:${20000 + Number(domain) * 100}`;
const sizes = [{width: 1280, height: 720}, {width: 360, height: 640}];
const views = ['camera', 'orbit', 'plan'];
const settleMs = 6000;   // the page finds what this machine can draw
const frameCategory = 'disabled-by-default-devtools.timeline.frame';

const json = path => fetch(url + path).then(answer => answer.json());
const pause = ms => new Promise(resolve => setTimeout(resolve, ms));

// Runs in the page before its own code: when the match is first seen with its map, and each frame's time.
const observer = `(() => {
    const seen = window.benchWindow = {times: [], picture: null};
    const frame = at => {
        seen.times.push(at);
        const state = seen.picture === null && window.cameraDirector?.state();
        if (state?.obstacles && state.players.length > 0 && state.cameras.length > 0) seen.picture = at;
        requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
})()`;

function quantile(sorted, part) {
    return sorted[Math.min(Math.floor(sorted.length * part), sorted.length - 1)];
}

// Processor time of each kind of Chromium's processes, s.
async function processorTime(browser) {
    const {processInfo} = await browser.send('SystemInfo.getProcessInfo', {}, 60e3, null);
    const sum = {};
    for (const {type, cpuTime} of processInfo) sum[type] = (sum[type] ?? 0) + cpuTime;
    return sum;
}

// Frames that the browser's compositor has drawn.
async function countDrawn(browser, during) {
    const from = browser.events.length;
    await browser.send('Tracing.start', {transferMode: 'ReportEvents', traceConfig: {includedCategories: [frameCategory]}});
    await during();
    await browser.send('Tracing.end');
    await eventually('the trace', () => browser.events.slice(from).some(({method}) => method === 'Tracing.tracingComplete'));
    return browser.events.slice(from).filter(({method}) => method === 'Tracing.dataCollected')
        .flatMap(({params}) => params.value).filter(({name}) => name === 'DrawFrame').length;
}

async function measure(browser) {
    const before = await processorTime(browser);
    const start = performance.now();
    await browser.evaluate('benchWindow.times.length = 0');
    const drawn = await countDrawn(browser, () => pause(seconds * 1000));
    const elapsed = (performance.now() - start) / 1000;
    const after = await processorTime(browser);
    const times = await browser.evaluate('benchWindow.times');
    const intervals = times.slice(1).map((at, i) => at - times[i]).sort((a, b) => a - b);
    const used = type => ((after[type] ?? 0) - (before[type] ?? 0)) / elapsed * 1000 / (drawn / elapsed);
    return {drawn: drawn / elapsed, called: (times.length - 1) * 1000 / (times[times.length - 1] - times[0]),
        p50: quantile(intervals, 0.5), p95: quantile(intervals, 0.95), p99: quantile(intervals, 0.99),
        page: used('renderer'), gpu: used('GPU'), browser: used('browser')};
}

const bytesLoaded = browser => browser.events.filter(({method}) => method === 'Network.loadingFinished')
    .reduce((sum, {params}) => sum + params.encodedDataLength, 0);

async function firstPicture(browser) {
    await browser.send('Network.clearBrowserCache');
    await browser.open('about:blank');
    browser.events.length = 0;
    await browser.open(`${url}/`);
    const ms = await browser.until('window.benchWindow?.picture');
    return {ms, bytes: bytesLoaded(browser)};
}

async function main() {
    const programs = new Programs(bin);
    let browser;
    try {
        programs.start('camera-director', 'serve', '--config', `${folder}/config.json`);
        programs.start('synthetic-players', `${folder}/map.vfs`, '--map-name', 'map', '--players', players,
            '--match-prefix', 'walk', '--rate', '60', '--domain', domain);
        programs.start('observer-probe', '--domain', domain, '--match-prefix', 'walk', '--observers', cameras,
            '--grace', '600', '--max-gaps', '1000000', '--max-violations', '1000000');
        await eventually('cameras', () => json('/live').then(live => live.matches[0]?.shots.length === Number(cameras)));
        browser = await Browser.start(sizes[0]);
        await browser.send('Page.addScriptToEvaluateOnNewDocument', {source: observer});
        console.log('| size | view | frames/s drawn | asked for | interval p50 / p95 / p99, ms | page, ms of processor a frame | GPU process | browser | quality |\n|---|---|---|---|---|---|---|---|---|');
        const loads = [];
        for (const size of sizes) {
            await browser.resize(size);
            loads.push({size, ...await firstPicture(browser)});
            for (const view of views) {
                await browser.evaluate(`document.querySelector('[data-view=${view}]').click()`);
                await pause(settleMs);
                const found = await measure(browser);
                const quality = await browser.evaluate('JSON.stringify(cameraDirector.state().quality)');
                console.log(`| ${size.width}x${size.height} | ${view} | ${found.drawn.toFixed(1)} | ${found.called.toFixed(1)} | ` +
                    `${[found.p50, found.p95, found.p99].map(ms => ms.toFixed(1)).join(' / ')} | ${found.page.toFixed(1)} | ` +
                    `${found.gpu.toFixed(1)} | ${found.browser.toFixed(1)} | ${quality} |`);
                if (pictures) writeFileSync(`${pictures}/${size.width}-${view}.png`, await browser.screenshot());
            }
        }
        for (const {size, ms, bytes} of loads)
            console.log(`${size.width}x${size.height}: first picture after ${ms.toFixed(0)} ms, ${bytes} bytes until then`);
    } catch (error) {
        console.log(error.stack, programs.logs());
        process.exitCode = 1;
    } finally {
        browser?.close();
        programs.kill();
    }
}

await main();
