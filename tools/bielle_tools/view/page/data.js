// The packed data: one zlib stream of all arrays, and the description that tells their places.

async function inflated(id) {
  const element = document.getElementById(id);
  const text = atob(element.textContent);
  element.textContent = "";
  const bytes = new Uint8Array(text.length);
  for (let k = 0; k < text.length; k++) bytes[k] = text.charCodeAt(k);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

const KINDS = {f4: Float32Array, i4: Int32Array, i2: Int16Array, u2: Uint16Array, i1: Int8Array, u1: Uint8Array};

class Arrays {
  constructor(bytes) { this.bytes = bytes; this.kept = new Map(); }

  /// The array at a place [offset, count, kind, length of rows that are stored as differences]; equal places give the same array.
  at(place) {
    const key = place.join();
    if (!this.kept.has(key)) this.kept.set(key, this.decoded(place));
    return this.kept.get(key);
  }

  decoded([offset, count, kind, length]) {
    const found = new KINDS[kind](count), width = found.BYTES_PER_ELEMENT, out = new Uint8Array(found.buffer);
    for (let part = 0; part < width; part++) {
      const from = offset + part * count;
      for (let k = 0; k < count; k++) out[k * width + part] = this.bytes[from + k];
    }
    for (let row = 0; length && row < count; row += length)
      for (let k = row + 1; k < row + length; k++) found[k] += found[k - 1];
    return found;
  }
}
