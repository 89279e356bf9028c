/** What of the carried library the planner uses: see tools/make_carried.mjs. Coordinates are whole numbers. */

export type Path = Array<{ x: number; y: number }>;

/** Several polygons made one, or taken from others: kinds are those of ClipType and FillRule. */
export class Clipper64 {
  addSubject(paths: Path[]): void;
  addClip(paths: Path[]): void;
  execute(kind: number, fill: number, found: Path[]): boolean;
}

/** Polygons widened: kinds are those of JoinType and EndType. */
export class ClipperOffset {
  constructor(miterLimit: number, arcTolerance: number);
  addPaths(paths: Path[], joined: number, ended: number): void;
  execute(by: number, found: Path[]): void;
}
