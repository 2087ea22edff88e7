// A headless Chromium, driven over a pipe with the DevTools protocol. It reaches nothing but this host.
import {spawn} from 'node:child_process';
import {mkdtempSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';

const options = [
    '--headless=new', '--no-sandbox', '--disable-gpu', '--use-gl=angle', '--use-angle=swiftshader',
    '--enable-unsafe-swiftshader', '--disable-quic', '--no-first-run', '--disable-background-networking',
    '--disable-component-update', '--disable-sync', '--disable-default-apps', '--disable-dev-shm-usage',
    '--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1', '--remote-debugging-pipe', 'about:blank',
];
const startMs = 120e3;

export class Browser {
    static async start(size = {width: 1280, height: 800, scale: 1, mobile: false}) {
        const browser = new Browser();
        browser.folder = mkdtempSync(join(tmpdir(), 'window-browser-'));
        browser.process = spawn('chromium', [`--user-data-dir=${browser.folder}`, ...options],
            {stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'], detached: true});
        browser.answers = new Map();
        browser.events = [];
        let received = '';
        browser.process.stdio[4].setEncoding('utf8').on('data', text => {
            received += text;
            for (let end; (end = received.indexOf('\0')) >= 0; received = received.slice(end + 1))
                browser.receive(JSON.parse(received.slice(0, end)));
        });
        browser.process.stdio[3].on('error', () => {});
        const targets = await browser.send('Target.getTargets', {}, startMs);
        const page = targets.targetInfos.find(target => target.type === 'page');
        const {sessionId} = await browser.send('Target.attachToTarget', {targetId: page.targetId, flatten: true});
        browser.session = sessionId;
        for (const domain of ['Page', 'Runtime', 'Network', 'Log']) await browser.send(`${domain}.enable`);
        await browser.resize(size);
        return browser;
    }

    receive(message) {
        if (message.id === undefined) return void this.events.push(message);
        const answer = this.answers.get(message.id);
        this.answers.delete(message.id);
        if (message.error) answer?.reject(new Error(message.error.message)); else answer?.resolve(message.result);
    }

    // To the page, once there is one; `session` null: to the browser.
    send(method, params = {}, limit = 60e3, session = this.session) {
        const id = this.last = (this.last ?? 0) + 1;
        const message = {id, method, params, ...(session ? {sessionId: session} : {})};
        return new Promise((resolve, reject) => {
            const timer = setTimeout(() => reject(new Error(`${method}: no answer`)), limit);
            const end = settle => value => { clearTimeout(timer); settle(value); };
            this.answers.set(id, {resolve: end(resolve), reject: end(reject)});
            this.process.stdio[3].write(JSON.stringify(message) + '\0');
        });
    }

    resize({width, height, scale = 1, mobile = false}) {
        return this.send('Emulation.setDeviceMetricsOverride', {width, height, deviceScaleFactor: scale, mobile});
    }

    open(url) {
        return this.send('Page.navigate', {url});
    }

    async evaluate(expression) {
        const {result, exceptionDetails} = await this.send('Runtime.evaluate',
            {expression, returnByValue: true, awaitPromise: true});
        if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
        return result.value;
    }

    // Waits until the expression is truthy, and returns it.
    async until(expression, limit = 90e3) {
        for (const end = Date.now() + limit;;) {
            const value = await this.evaluate(expression);
            if (value) return value;
            if (Date.now() > end) throw new Error(`never: ${expression}`);
            await new Promise(resolve => setTimeout(resolve, 100));
        }
    }

    async press(key, {code = key, shift = false} = {}) {
        const text = key.length === 1 ? key : key === 'Enter' ? '\r' : undefined;
        const params = {key, code, text, modifiers: shift ? 8 : 0, windowsVirtualKeyCode: {Tab: 9, Enter: 13, Escape: 27, PageUp: 33, PageDown: 34, End: 35, Home: 36}[key]};
        await this.send('Input.dispatchKeyEvent', {type: 'keyDown', ...params});
        await this.send('Input.dispatchKeyEvent', {type: 'keyUp', ...params});
    }

    async screenshot() {
        const {data} = await this.send('Page.captureScreenshot', {format: 'png'});
        return Buffer.from(data, 'base64');
    }

    // What the page complained of.
    complaints() {
        return this.events.filter(({method, params}) => method === 'Runtime.exceptionThrown' ||
            (method === 'Log.entryAdded' && params.entry.level === 'error') ||
            (method === 'Runtime.consoleAPICalled' && params.type === 'error'))
            .map(({params}) => params.entry?.text ?? params.exceptionDetails?.exception?.description ?? JSON.stringify(params.args));
    }

    close() {
        try {
            process.kill(-this.process.pid, 'SIGKILL');
        } catch {
            // It has ended by itself.
        }
        rmSync(this.folder, {recursive: true, force: true, maxRetries: 5, retryDelay: 200});
    }
}
