// A match's stream, again and again: what is lost is joined again, later and later.
import {subprotocol} from './protocol.js';

const firstRetryMs = 500;
const longestRetryMs = 15e3;
export const silenceMs = 12e3;

// `token()`: what the server wants; null: nothing. Calls `on.note(object)`, `on.frame(ArrayBuffer)` and
// `on.state(name, ms until the next attempt)`: connecting, open, silent, waiting.
export class Connection {
    constructor(token, on) {
        this.token = token;
        this.on = on;
        this.retryMs = firstRetryMs;
        this.refusals = 0;  // in a row
    }

    watch(matchId) {
        this.close();
        this.matchId = matchId;
        this.retryMs = firstRetryMs;
        this.refusals = 0;
        this.open();
    }

    close() {
        clearTimeout(this.timer);
        clearTimeout(this.silence);
        this.isSilent = this.isOpen = false;
        const socket = this.socket;
        this.socket = null;
        socket?.close();
    }

    open() {
        const scheme = location.protocol === 'https:' ? 'wss:' : 'ws:';
        const protocols = [subprotocol];
        // A browser cannot set the header Authorization of a WebSocket.
        const token = this.token();
        if (token) protocols.push(`bearer.${encodeURIComponent(token)}`);
        this.on.state('connecting');
        const url = `${scheme}//${location.host}/live/${encodeURIComponent(this.matchId)}`;
        let socket;
        try {
            socket = new WebSocket(url, protocols);
        } catch {  // the token has characters that no subprotocol may have, and so is none
            ++this.refusals;
            return this.retry();
        }
        this.socket = socket;
        socket.binaryType = 'arraybuffer';
        socket.onopen = () => {
            if (socket !== this.socket) return;
            this.refusals = 0;
            this.isOpen = true;
            this.on.state('open');
        };
        socket.onmessage = ({data}) => {
            if (socket !== this.socket) return;
            this.retryMs = firstRetryMs;
            this.expectMore();
            if (this.isSilent) this.on.state('open');
            this.isSilent = false;
            if (typeof data === 'string') this.on.note(JSON.parse(data)); else this.on.frame(data);
        };
        socket.onclose = () => {
            if (socket !== this.socket) return;
            if (!this.isOpen) ++this.refusals;
            this.retry();
        };
        this.expectMore();
    }

    // Either the match stands still or the network is gone, which closes nothing.
    expectMore() {
        clearTimeout(this.silence);
        this.silence = setTimeout(() => this.silent(), silenceMs);
    }

    silent() {
        if (this.socket?.readyState !== WebSocket.OPEN) return this.retry();
        this.isSilent = true;
        this.on.state('silent');
    }

    // The server does not answer otherwise either: it refuses nobody, and a stream that is silent is lost.
    unreachable() {
        this.refusals = 0;
        if (this.isSilent) this.retry();
    }

    // The match does not stand still: a stream that is silent came by a network that is gone.
    runs() {
        if (this.isSilent) this.retry();
    }

    retry() {
        this.close();
        const wait = this.retryMs * (0.75 + Math.random() / 2);
        this.retryMs = Math.min(this.retryMs * 2, longestRetryMs);
        this.on.state('waiting', wait);
        this.timer = setTimeout(() => this.open(), wait);
    }
}
