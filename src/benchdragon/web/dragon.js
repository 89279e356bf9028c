// A dragon's head and lantern benches, drawn at true size: all of a bench's drawing lies inside its rectangle.

/** @typedef {import("./nearness.js").Boxes} Boxes */
/** @typedef {import("./camera.js").Camera} Camera */
/** @typedef {import("./paint.js").Inks} Inks */
/** @typedef {[number, number]} Spot along a bench and across it to the left, m, from its centre */

/**
 * What a bench is drawn of, in metres from its centre, ahead and to the left.
 * @typedef {object} Drawing
 * @property {Path2D} plank
 * @property {Path2D} grain
 * @property {Path2D} cloth
 * @property {Path2D} scales
 * @property {Path2D} lanterns
 * @property {Path2D} lights
 * @property {Path2D} ribs
 * @property {Path2D} sockets
 * @property {HeadDrawing | null} head
 * @property {Path2D | null} fin of the last bench
 */

/** @typedef {Record<"mane" | "skull" | "horns" | "whites" | "pupils" | "whiskers" | "brow", Path2D>} HeadDrawing */

/** Width of a bench, CSS pixels, from which it is drawn in colours, and with all its lines. */
const COLOURED_FROM = 4.5;
const LINED_FROM = 14;
/** A head is so many half widths long, and no more than this share of its bench. */
const HEAD_LENGTH = 6.6;
const HEAD_SHARE = 0.45;
/** One lantern for each so many half widths of cloth. */
const LANTERN_EACH = 4.4;
const MOST_LANTERNS = 4;

export class Dress {
  /** @param {Boxes} boxes */
  constructor(boxes) {
    /** @type {Map<string, Drawing>} */
    const made = new Map();
    this.of = Array.from(boxes.half, (half, i) => {
      const [first, last] = [i === 0, i === boxes.count - 1];
      const key = [half, boxes.wide[i], boxes.inset[i], boxes.rear[i], first, last].join(" ");
      const drawing = made.get(key) ?? drawingOf(boxes, i);
      made.set(key, drawing);
      return drawing;
    });
    this.widest = 2 * boxes.wide.reduce((a, b) => Math.max(a, b), 0);
  }

  /** Whether benches are large enough on the canvas to be drawn so. @param {Camera} camera */
  shows({ scale }) {
    return this.widest * scale >= COLOURED_FROM;
  }

  /**
   * Draw benches, from the tail to the head: each lies upon the one behind it.
   * @param {CanvasRenderingContext2D} ctx
   * @param {Boxes} boxes
   * @param {Camera} camera
   * @param {Inks} inks
   * @param {number[]} seen
   */
  paint(ctx, boxes, camera, inks, seen) {
    const before = ctx.getTransform();
    const lined = this.widest * camera.scale >= LINED_FROM;
    for (let n = seen.length - 1; n >= 0; n--) {
      const i = seen[n];
      place(ctx, before, boxes, camera, i);
      const pen = new Pen(ctx, inks, camera.scale);
      pen.bench(this.of[i], lined);
      const { head, fin } = this.of[i];
      if (fin) pen.tail(fin);
      if (head) pen.head(head, lined);
      pen.outline(this.of[i]);
    }
    ctx.setTransform(before);
  }
}

/** Have the canvas take metres of a bench. @param {CanvasRenderingContext2D} ctx @param {DOMMatrix} before @param {Boxes} boxes @param {Camera} camera @param {number} i */
function place(ctx, before, boxes, camera, i) {
  const [px, py] = camera.toScreen(boxes.x[i], boxes.y[i]);
  const [right, up] = [boxes.ux[i] * camera.scale, boxes.uy[i] * camera.scale];
  ctx.setTransform(before);
  ctx.transform(right, -up, -up, -right, px, py);
}

/** Fills and strokes the parts of a bench. */
class Pen {
  /** @param {CanvasRenderingContext2D} ctx @param {Inks} inks @param {number} scale CSS pixels a metre */
  constructor(ctx, inks, scale) {
    this.ctx = ctx;
    this.inks = inks;
    /** A CSS pixel, m. */
    this.pixel = 1 / scale;
  }

  /** @param {Path2D} path @param {string} colour */
  #fill(path, colour) {
    this.ctx.fillStyle = colour;
    this.ctx.fill(path);
  }

  /** @param {Path2D} path @param {string} colour @param {number} metres @param {number} [least] CSS pixels */
  #stroke(path, colour, metres, least = 0.5) {
    this.ctx.strokeStyle = colour;
    this.ctx.lineWidth = Math.max(metres, least * this.pixel);
    this.ctx.stroke(path);
  }

  /** @param {Drawing} drawing @param {boolean} lined */
  bench(drawing, lined) {
    const { inks } = this;
    this.#fill(drawing.plank, inks.wood);
    if (lined) this.#stroke(drawing.grain, inks.grain, 0.004);
    this.#fill(drawing.cloth, drawing.head ? inks.head : inks.cloth);
    if (lined) this.#stroke(drawing.scales, inks.gold, 0.005);
    if (lined) this.#stroke(drawing.cloth, inks.gold, 0.009);
    this.#fill(drawing.lanterns, inks.lantern);
    this.#fill(drawing.lights, inks.glow);
    if (lined) {
      this.#stroke(drawing.ribs, inks.rib, 0.005);
      this.#fill(drawing.sockets, inks.grain);
    }
  }

  /** @param {Drawing} drawing */
  outline({ plank }) {
    this.#stroke(plank, this.inks.outline, 0.008, 0.7);
  }

  /** @param {Path2D} fin */
  tail(fin) {
    this.ctx.lineJoin = "round";
    this.#fill(fin, this.inks.head);
    this.#stroke(fin, this.inks.gold, 0.008);
    this.ctx.lineJoin = "miter";
  }

  /** @param {HeadDrawing} face @param {boolean} lined */
  head(face, lined) {
    const { ctx, inks } = this;
    ctx.lineJoin = "round";
    ctx.lineCap = "round";
    this.#fill(face.mane, inks.gold);
    if (lined) this.#stroke(face.mane, inks.rib, 0.004);
    this.#fill(face.skull, inks.head);
    if (lined) {
      this.#stroke(face.skull, inks.rib, 0.007);
      this.#stroke(face.horns, inks.rib, 0.036);
      this.#stroke(face.horns, inks.horn, 0.024);
      this.#stroke(face.whiskers, inks.gold, 0.01);
      this.#stroke(face.brow, inks.gold, 0.012);
    }
    this.#fill(face.whites, inks.horn);
    if (lined) this.#fill(face.pupils, "#111");
    ctx.lineCap = "butt";
    ctx.lineJoin = "miter";
  }
}

/** @param {Boxes} boxes @param {number} i @returns {Drawing} */
function drawingOf(boxes, i) {
  const [half, wide] = [boxes.half[i], boxes.wide[i]];
  const head = i === 0 ? Math.min(HEAD_LENGTH * wide, HEAD_SHARE * 2 * half) : 0;
  const fin = i > 0 && i === boxes.count - 1 ? Math.min(4 * wide, 0.5 * half) : 0;
  /** @type {[number, number]} */
  const handles = [half - boxes.inset[i], boxes.rear[i] - half];
  const front = head ? half - 0.86 * head : handles[0] - 0.9 * wide;
  const back = fin ? 0.6 * fin - half : handles[1] + 0.9 * wide;
  return {
    plank: rectangle(-half, half, wide),
    grain: grainOf(half, wide),
    ...clothOf(Math.min(back, front), front, wide),
    sockets: discs(
      handles.map((x) => [x, 0]),
      0.36 * wide,
    ),
    head: head ? faceOf(half, wide, head) : null,
    fin: fin ? finOf(half, wide, fin) : null,
  };
}

/** @param {number} back @param {number} front @param {number} wide */
function rectangle(back, front, wide) {
  const path = new Path2D();
  path.rect(back, -wide, front - back, 2 * wide);
  return path;
}

/** @param {Spot[]} spots @param {number} radius */
function discs(spots, radius) {
  const path = new Path2D();
  for (const [x, y] of spots) {
    path.moveTo(x + radius, y);
    path.arc(x, y, radius, 0, 2 * Math.PI);
  }
  return path;
}

/** @param {number} half @param {number} wide */
function grainOf(half, wide) {
  const path = new Path2D();
  for (const across of [-0.86, -0.8, 0.8, 0.86]) {
    path.moveTo(-half, across * wide);
    path.lineTo(half, across * wide);
  }
  return path;
}

/** The cloth on a bench from one place to another, its scales, and the lanterns on it. @param {number} back @param {number} front @param {number} wide */
function clothOf(back, front, wide) {
  const length = front - back;
  const count = Math.min(Math.max(Math.round(length / (LANTERN_EACH * wide)), 1), MOST_LANTERNS);
  /** @type {Spot[]} */
  const spots = Array.from({ length: count }, (_unused, n) => [back + ((n + 0.5) / count) * length, 0]);
  const radius = Math.min(0.66 * wide, (0.4 * length) / count);
  return {
    cloth: rectangle(back, front, 0.72 * wide),
    scales: scalesOf(back, front, 0.72 * wide),
    lanterns: discs(spots, radius),
    lights: discs(spots, 0.5 * radius),
    ribs: ribsOf(spots, radius),
  };
}

/** Rows of half circles, which open ahead: scales lie tailwards. @param {number} back @param {number} front @param {number} wide */
function scalesOf(back, front, wide) {
  const path = new Path2D();
  const radius = wide / 3;
  const rows = Math.floor((front - back - radius) / radius);
  for (let row = 0; row < rows; row++) {
    const x = back + radius * (row + 1);
    const across = row % 2 ? [-2 / 3, 0, 2 / 3] : [-1 / 3, 1 / 3];
    for (const y of across.map((share) => share * wide)) {
      path.moveTo(x, y + radius);
      path.arc(x, y, radius, 0.5 * Math.PI, 1.5 * Math.PI);
    }
  }
  return path;
}

/** Ribs of lanterns from above, and their rims. @param {Spot[]} spots @param {number} radius */
function ribsOf(spots, radius) {
  const path = discs(spots, radius);
  for (const [x, y] of spots) {
    for (let n = 0; n < 8; n++) {
      const [cos, sin] = [Math.cos((n * Math.PI) / 4), Math.sin((n * Math.PI) / 4)];
      path.moveTo(x + 0.5 * radius * cos, y + 0.5 * radius * sin);
      path.lineTo(x + radius * cos, y + radius * sin);
    }
  }
  return path;
}

/** A path through spots that are told from the nose backwards in head lengths, and across in half widths; both mirrored. @param {(at: (back: number, across: number) => Spot, path: Path2D) => void} draw @param {number} half @param {number} wide @param {number} length */
function mirrored(draw, half, wide, length) {
  const path = new Path2D();
  for (const side of [1, -1])
    draw((back, across) => [half - back * length, side * across * wide], path);
  return path;
}

/** The dragon's head from above: snout ahead, mane and horns behind. @param {number} half @param {number} wide @param {number} length @returns {HeadDrawing} */
function faceOf(half, wide, length) {
  const both = (/** @type {Parameters<typeof mirrored>[0]} */ draw) =>
    mirrored(draw, half, wide, length);
  return {
    mane: both(maneSide),
    skull: both(skullSide),
    horns: both((at, path) => {
      path.moveTo(...at(0.5, 0.28));
      path.bezierCurveTo(...at(0.64, 0.3), ...at(0.78, 0.34), ...at(0.97, 0.66));
      path.moveTo(...at(0.74, 0.37));
      path.quadraticCurveTo(...at(0.8, 0.6), ...at(0.84, 0.8));
    }),
    whites: eyes(half, wide, length, 0.2),
    pupils: eyes(half, wide, length, 0.1),
    whiskers: both((at, path) => {
      path.moveTo(...at(0.07, 0.36));
      path.bezierCurveTo(...at(0.1, 0.8), ...at(0.2, 0.94), ...at(0.36, 0.92));
    }),
    brow: both((at, path) => {
      path.moveTo(...at(0.02, 0.06));
      path.lineTo(...at(0.2, 0.1));
      path.moveTo(...at(0.05, 0.24));
      path.lineTo(...at(0.07, 0.16));
      path.moveTo(...at(0.34, 0.66));
      path.quadraticCurveTo(...at(0.4, 0.3), ...at(0.52, 0.24));
    }),
  };
}

/** @param {(back: number, across: number) => Spot} at @param {Path2D} path */
function skullSide(at, path) {
  path.moveTo(...at(0.005, 0));
  path.bezierCurveTo(...at(0.005, 0.3), ...at(0.03, 0.52), ...at(0.09, 0.5));
  path.bezierCurveTo(...at(0.15, 0.46), ...at(0.19, 0.4), ...at(0.26, 0.52));
  path.bezierCurveTo(...at(0.31, 0.62), ...at(0.34, 0.82), ...at(0.41, 0.84));
  path.bezierCurveTo(...at(0.5, 0.86), ...at(0.52, 0.66), ...at(0.66, 0.5));
  path.quadraticCurveTo(...at(0.76, 0.4), ...at(0.84, 0));
  path.closePath();
}

/** Flames, from the cheeks backwards. @param {(back: number, across: number) => Spot} at @param {Path2D} path */
function maneSide(at, path) {
  path.moveTo(...at(0.36, 0));
  path.lineTo(...at(0.38, 0.8));
  for (const [root, tip, across] of [
    [0.46, 0.62, 0.98],
    [0.58, 0.78, 0.94],
    [0.7, 0.92, 0.8],
    [0.8, 1, 0.42],
  ]) {
    path.quadraticCurveTo(...at(root, across + 0.02), ...at(tip, across));
    path.lineTo(...at(root + 0.1, 0.52 * across));
  }
  path.lineTo(...at(0.9, 0));
  path.closePath();
}

/** @param {number} half @param {number} wide @param {number} length @param {number} size in half widths */
function eyes(half, wide, length, size) {
  const path = new Path2D();
  for (const side of [1, -1]) {
    const [x, y] = [half - 0.37 * length, side * 0.52 * wide];
    path.moveTo(x + 1.5 * size * wide, y);
    path.ellipse(x, y, 1.5 * size * wide, size * wide, 0, 0, 2 * Math.PI);
  }
  return path;
}

/** The tail's fin, which opens backwards. @param {number} half @param {number} wide @param {number} length */
function finOf(half, wide, length) {
  const path = new Path2D();
  const at = (/** @type {number} */ back, /** @type {number} */ across) =>
    /** @type {Spot} */ ([length * (1 - back) - half, across * wide]);
  path.moveTo(...at(0, 0));
  path.bezierCurveTo(...at(0.3, 0.2), ...at(0.5, 0.9), ...at(1, 0.96));
  path.quadraticCurveTo(...at(0.8, 0.5), ...at(0.86, 0.34));
  path.quadraticCurveTo(...at(0.95, 0.2), ...at(1, 0));
  path.quadraticCurveTo(...at(0.95, -0.2), ...at(0.86, -0.34));
  path.quadraticCurveTo(...at(0.8, -0.5), ...at(1, -0.96));
  path.bezierCurveTo(...at(0.5, -0.9), ...at(0.3, -0.2), ...at(0, 0));
  path.closePath();
  return path;
}
