// The mesh as conformal_uv/page/packing.py wrote it.

/** All bytes of a text in base 64 that zlib compressed. */
export async function inflated(text) {
  const raw = atob(text.trim());
  const bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; i++) bytes[i] = raw.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Typed arrays by name, of the headers and the bytes of all: whole numbers as Uint32Array, others as Float32Array. */
export function decoded(headers, bytes) {
  const arrays = {};
  let begin = 0;
  for (const header of headers) {
    arrays[header.name] = columns(header, bytes, begin);
    begin += header.rows * header.columns * header.width;
  }
  return arrays;
}

function columns({ name, rows, columns, width, low, step }, bytes, begin) {
  const whole = name === "faces";
  const out = whole ? new Uint32Array(rows * columns) : new Float32Array(rows * columns);
  const full = 2 ** (8 * width);
  for (let k = 0; k < columns; k++) {
    let value = 0;
    for (let i = 0; i < rows; i++) {
      let near = 0;
      for (let plane = 0; plane < width; plane++) near += bytes[begin + plane * rows + i] * 2 ** (8 * plane);
      value += near % 2 ? -(near + 1) / 2 : near / 2;
      if (value < 0) value += full;
      else if (value >= full) value -= full;
      out[i * columns + k] = whole ? value : low[k] + value * step;
    }
    begin += rows * width;
  }
  return out;
}
