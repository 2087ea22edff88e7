// Reads the fields of recordings, little-endian (idl/recording.md).

const floatBits = new DataView(new ArrayBuffer(4));
const utf8 = new TextDecoder();

// What a recording is damaged by; the message says where and what was expected.
export class Damaged extends Error {}

export function floatOf(bits) {
    floatBits.setUint32(0, bits);
    return floatBits.getFloat32(0);
}

export class ByteSource {
    // `name`: of what is read, for errors.
    constructor(bytes, name) {
        this.bytes = bytes;
        this.name = name;
        this.at = 0;
    }

    get left() { return this.bytes.length - this.at; }

    fail(expected) {
        throw new Damaged(`${this.name}: byte ${this.at}: expected ${expected}`);
    }

    u8() {
        if (this.at >= this.bytes.length) this.fail('more bytes');
        return this.bytes[this.at++];
    }

    u32() {
        return this.u8() + this.u8() * 0x100 + this.u8() * 0x10000 + this.u8() * 0x1000000;
    }

    u64() {
        return BigInt(this.u32()) + (BigInt(this.u32()) << 32n);
    }

    float() {
        return floatOf(this.u32());
    }

    // A varint below 2^53.
    number() {
        let value = 0;
        for (let scale = 1;; scale *= 128) {
            const byte = this.u8();
            value += (byte & 0x7f) * scale;
            if (value > Number.MAX_SAFE_INTEGER || scale > 2 ** 63) this.fail('a smaller number');
            if (byte < 0x80) return value;
        }
    }

    // A varint of at most 32 bits.
    id() {
        const value = this.number();
        if (value > 0xffffffff) this.fail('a number of at most 32 bits');
        return value;
    }

    // A varint of 64 bits.
    big() {
        let low = 0;  // of 49 bits
        let high = 0;
        for (let i = 0; i < 10; ++i) {
            const byte = this.u8();
            if (i < 7) low += (byte & 0x7f) * 2 ** (7 * i); else high += (byte & 0x7f) * 2 ** (7 * (i - 7));
            if (high > 0x7fff) break;
            if (byte < 0x80) return BigInt(low) + (BigInt(high) << 49n);
        }
        return this.fail('a number of at most 64 bits');
    }

    // `signed` of 64 bits.
    bigDifference() {
        const value = this.big();
        return (value >> 1n) ^ -(value & 1n);
    }

    // `signed` of 32 bits.
    difference() {
        const value = this.id();
        return (value >>> 1) ^ -(value & 1);
    }

    text() {
        return utf8.decode(this.take(this.number()));
    }

    // How many elements follow, each of at least `size` bytes: at most `max`.
    count(size, max = Infinity) {
        const value = this.number();
        if (value > max || value * size > this.left) this.fail(`a list of at most ${Math.min(max, Math.floor(this.left / size))}`);
        return value;
    }

    take(size) {
        if (size > this.left) this.fail(`${size} bytes`);
        this.at += size;
        return this.bytes.subarray(this.at - size, this.at);
    }
}
