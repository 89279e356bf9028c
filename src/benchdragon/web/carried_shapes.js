// clipper2-ts 2.0.1, bundled by esbuild 0.28.2: see carried.txt

// node_modules/clipper2-ts/dist/Core.js
var ClipType;
(function(ClipType2) {
  ClipType2[ClipType2.NoClip = 0] = "NoClip", ClipType2[ClipType2.Intersection = 1] = "Intersection", ClipType2[ClipType2.Union = 2] = "Union", ClipType2[ClipType2.Difference = 3] = "Difference", ClipType2[ClipType2.Xor = 4] = "Xor";
})(ClipType || (ClipType = {}));
var PathType;
(function(PathType2) {
  PathType2[PathType2.Subject = 0] = "Subject", PathType2[PathType2.Clip = 1] = "Clip";
})(PathType || (PathType = {}));
var FillRule;
(function(FillRule2) {
  FillRule2[FillRule2.EvenOdd = 0] = "EvenOdd", FillRule2[FillRule2.NonZero = 1] = "NonZero", FillRule2[FillRule2.Positive = 2] = "Positive", FillRule2[FillRule2.Negative = 3] = "Negative";
})(FillRule || (FillRule = {}));
var PointInPolygonResult;
(function(PointInPolygonResult2) {
  PointInPolygonResult2[PointInPolygonResult2.IsOn = 0] = "IsOn", PointInPolygonResult2[PointInPolygonResult2.IsInside = 1] = "IsInside", PointInPolygonResult2[PointInPolygonResult2.IsOutside = 2] = "IsOutside";
})(PointInPolygonResult || (PointInPolygonResult = {}));
var InternalClipper;
(function(InternalClipper2) {
  InternalClipper2.MaxInt64 = 9223372036854775807n, InternalClipper2.MaxCoord = Number(InternalClipper2.MaxInt64 / 4n), InternalClipper2.max_coord = InternalClipper2.MaxCoord, InternalClipper2.min_coord = -InternalClipper2.MaxCoord, InternalClipper2.Invalid64 = Number(InternalClipper2.MaxInt64), InternalClipper2.floatingPointTolerance = 1e-12, InternalClipper2.defaultMinimumEdgeLength = 0.1;
  function crossProduct(pt1, pt2, pt3) {
    return (pt2.x - pt1.x) * (pt3.y - pt2.y) - (pt2.y - pt1.y) * (pt3.x - pt2.x);
  }
  InternalClipper2.crossProduct = crossProduct;
  function crossProductSign(pt1, pt2, pt3) {
    let a = pt2.x - pt1.x, b = pt3.y - pt2.y, c = pt2.y - pt1.y, d = pt3.x - pt2.x;
    if (Math.abs(a) < 9e7 && Math.abs(b) < 9e7 && Math.abs(c) < 9e7 && Math.abs(d) < 9e7) {
      let prod12 = a * b, prod22 = c * d;
      return prod12 > prod22 ? 1 : prod12 < prod22 ? -1 : 0;
    }
    let signA = a < 0 ? -1 : a > 0 ? 1 : 0, signB = b < 0 ? -1 : b > 0 ? 1 : 0, signC = c < 0 ? -1 : c > 0 ? 1 : 0, signD = d < 0 ? -1 : d > 0 ? 1 : 0, signAB = signA * signB, signCD = signC * signD;
    if (signAB !== signCD)
      return signAB > signCD ? 1 : -1;
    if (signAB === 0)
      return 0;
    let bigA = BigInt(a), bigB = BigInt(b), bigC = BigInt(c), bigD = BigInt(d), prod1 = bigA * bigB, prod2 = bigC * bigD;
    return prod1 === prod2 ? 0 : prod1 > prod2 ? 1 : -1;
  }
  InternalClipper2.crossProductSign = crossProductSign;
  function checkPrecision(precision) {
    if (precision < -8 || precision > 8)
      throw new Error("Error: Precision is out of range.");
  }
  InternalClipper2.checkPrecision = checkPrecision;
  function isAlmostZero(value) {
    return Math.abs(value) <= InternalClipper2.floatingPointTolerance;
  }
  InternalClipper2.isAlmostZero = isAlmostZero;
  function triSign(x) {
    return x < 0 ? -1 : x > 0 ? 1 : 0;
  }
  InternalClipper2.triSign = triSign;
  function multiplyUInt64(a, b) {
    let aBig = BigInt(a), bBig = BigInt(b), res = aBig * bBig;
    return {
      lo64: Number(res & 0xffffffffffffffffn),
      hi64: Number(res >> 64n)
    };
  }
  InternalClipper2.multiplyUInt64 = multiplyUInt64;
  function productsAreEqual(a, b, c, d) {
    let absA = Math.abs(a), absB = Math.abs(b), absC = Math.abs(c), absD = Math.abs(d);
    if (absA < 46341 && absB < 46341 && absC < 46341 && absD < 46341 || absA < 9e7 && absB < 9e7 && absC < 9e7 && absD < 9e7)
      return a * b === c * d;
    let signAb = (a < 0 ? -1 : a > 0 ? 1 : 0) * (b < 0 ? -1 : b > 0 ? 1 : 0), signCd = (c < 0 ? -1 : c > 0 ? 1 : 0) * (d < 0 ? -1 : d > 0 ? 1 : 0);
    if (signAb !== signCd)
      return !1;
    if (signAb === 0)
      return !0;
    let bigA = BigInt(absA), bigB = BigInt(absB), bigC = BigInt(absC), bigD = BigInt(absD);
    return bigA * bigB === bigC * bigD;
  }
  InternalClipper2.productsAreEqual = productsAreEqual;
  function isCollinear(pt1, sharedPt, pt2) {
    let a = sharedPt.x - pt1.x, b = pt2.y - sharedPt.y, c = sharedPt.y - pt1.y, d = pt2.x - sharedPt.x;
    return productsAreEqual(a, b, c, d);
  }
  InternalClipper2.isCollinear = isCollinear;
  function dotProduct(pt1, pt2, pt3) {
    return (pt2.x - pt1.x) * (pt3.x - pt2.x) + (pt2.y - pt1.y) * (pt3.y - pt2.y);
  }
  InternalClipper2.dotProduct = dotProduct;
  function crossProductD(vec1, vec2) {
    return vec1.y * vec2.x - vec2.y * vec1.x;
  }
  InternalClipper2.crossProductD = crossProductD;
  function dotProductD(vec1, vec2) {
    return vec1.x * vec2.x + vec1.y * vec2.y;
  }
  InternalClipper2.dotProductD = dotProductD;
  function roundToEven(value) {
    let floor = Math.floor(value), diff = value - floor;
    return Math.abs(diff - 0.5) < 1e-10 ? floor % 2 === 0 ? floor : floor + 1 : Math.round(value);
  }
  InternalClipper2.roundToEven = roundToEven;
  function checkCastInt64(val) {
    return val >= InternalClipper2.max_coord || val <= InternalClipper2.min_coord ? InternalClipper2.Invalid64 : Math.round(val);
  }
  InternalClipper2.checkCastInt64 = checkCastInt64;
  function getLineIntersectPt(ln1a, ln1b, ln2a, ln2b) {
    let dy1 = ln1b.y - ln1a.y, dx1 = ln1b.x - ln1a.x, dy2 = ln2b.y - ln2a.y, dx2 = ln2b.x - ln2a.x, det = dy1 * dx2 - dy2 * dx1;
    if (det === 0)
      return { intersects: !1, point: { x: 0, y: 0, z: 0 } };
    let t = ((ln1a.x - ln2a.x) * dy2 - (ln1a.y - ln2a.y) * dx2) / det, ip;
    if (t <= 0)
      ip = { x: ln1a.x, y: ln1a.y, z: 0 };
    else if (t >= 1)
      ip = { x: ln1b.x, y: ln1b.y, z: 0 };
    else {
      let rawX = ln1a.x + t * dx1, rawY = ln1a.y + t * dy1;
      ip = {
        x: Math.trunc(rawX),
        y: Math.trunc(rawY),
        z: 0
      };
    }
    return { intersects: !0, point: ip };
  }
  InternalClipper2.getLineIntersectPt = getLineIntersectPt;
  function getLineIntersectPtD(ln1a, ln1b, ln2a, ln2b) {
    let dy1 = ln1b.y - ln1a.y, dx1 = ln1b.x - ln1a.x, dy2 = ln2b.y - ln2a.y, dx2 = ln2b.x - ln2a.x, det = dy1 * dx2 - dy2 * dx1;
    if (det === 0)
      return { success: !1, ip: { x: 0, y: 0, z: 0 } };
    let t = ((ln1a.x - ln2a.x) * dy2 - (ln1a.y - ln2a.y) * dx2) / det, ip;
    return t <= 0 ? ip = { ...ln1a, z: 0 } : t >= 1 ? ip = { ...ln1b, z: 0 } : ip = {
      x: ln1a.x + t * dx1,
      y: ln1a.y + t * dy1,
      z: 0
    }, { success: !0, ip };
  }
  InternalClipper2.getLineIntersectPtD = getLineIntersectPtD;
  function segsIntersect(seg1a, seg1b, seg2a, seg2b, inclusive = !1) {
    if (!inclusive)
      return crossProduct(seg1a, seg2a, seg2b) * crossProduct(seg1b, seg2a, seg2b) < 0 && crossProduct(seg2a, seg1a, seg1b) * crossProduct(seg2b, seg1a, seg1b) < 0;
    let res1 = crossProduct(seg1a, seg2a, seg2b), res2 = crossProduct(seg1b, seg2a, seg2b);
    if (res1 * res2 > 0)
      return !1;
    let res3 = crossProduct(seg2a, seg1a, seg1b), res4 = crossProduct(seg2b, seg1a, seg1b);
    return res3 * res4 > 0 ? !1 : res1 !== 0 || res2 !== 0 || res3 !== 0 || res4 !== 0;
  }
  InternalClipper2.segsIntersect = segsIntersect;
  function getBounds(path) {
    if (path.length === 0)
      return { left: 0, top: 0, right: 0, bottom: 0 };
    let result = {
      left: Number.MAX_SAFE_INTEGER,
      top: Number.MAX_SAFE_INTEGER,
      right: Number.MIN_SAFE_INTEGER,
      bottom: Number.MIN_SAFE_INTEGER
    };
    for (let pt of path)
      pt.x < result.left && (result.left = pt.x), pt.x > result.right && (result.right = pt.x), pt.y < result.top && (result.top = pt.y), pt.y > result.bottom && (result.bottom = pt.y);
    return result.left === Number.MAX_SAFE_INTEGER ? { left: 0, top: 0, right: 0, bottom: 0 } : result;
  }
  InternalClipper2.getBounds = getBounds;
  function getClosestPtOnSegment(offPt, seg1, seg2) {
    if (seg1.x === seg2.x && seg1.y === seg2.y)
      return { x: seg1.x, y: seg1.y, z: 0 };
    let dx = seg2.x - seg1.x, dy = seg2.y - seg1.y, q = ((offPt.x - seg1.x) * dx + (offPt.y - seg1.y) * dy) / (dx * dx + dy * dy), qClamped = q < 0 ? 0 : q > 1 ? 1 : q;
    return {
      // use Math.round to match the C# MidpointRounding.ToEven behavior
      x: Math.round(seg1.x + qClamped * dx),
      y: Math.round(seg1.y + qClamped * dy),
      z: 0
    };
  }
  InternalClipper2.getClosestPtOnSegment = getClosestPtOnSegment;
  function pointInPolygon(pt, polygon) {
    let len = polygon.length, start = 0;
    if (len < 3)
      return PointInPolygonResult.IsOutside;
    for (; start < len && polygon[start].y === pt.y; )
      start++;
    if (start === len)
      return PointInPolygonResult.IsOutside;
    let isAbove = polygon[start].y < pt.y, startingAbove = isAbove, val = 0, i = start + 1, end = len;
    for (; ; ) {
      if (i === end) {
        if (end === 0 || start === 0)
          break;
        end = start, i = 0;
      }
      if (isAbove)
        for (; i < end && polygon[i].y < pt.y; )
          i++;
      else
        for (; i < end && polygon[i].y > pt.y; )
          i++;
      if (i === end)
        continue;
      let curr = polygon[i], prev = i > 0 ? polygon[i - 1] : polygon[len - 1];
      if (curr.y === pt.y) {
        if (curr.x === pt.x || curr.y === prev.y && pt.x < prev.x != pt.x < curr.x)
          return PointInPolygonResult.IsOn;
        if (i++, i === start)
          break;
        continue;
      }
      if (!(pt.x < curr.x && pt.x < prev.x))
        if (pt.x > prev.x && pt.x > curr.x)
          val = 1 - val;
        else {
          let cps2 = crossProductSign(prev, curr, pt);
          if (cps2 === 0)
            return PointInPolygonResult.IsOn;
          cps2 < 0 === isAbove && (val = 1 - val);
        }
      isAbove = !isAbove, i++;
    }
    if (isAbove === startingAbove)
      return val === 0 ? PointInPolygonResult.IsOutside : PointInPolygonResult.IsInside;
    i === len && (i = 0);
    let cps = i === 0 ? crossProductSign(polygon[len - 1], polygon[0], pt) : crossProductSign(polygon[i - 1], polygon[i], pt);
    return cps === 0 ? PointInPolygonResult.IsOn : (cps < 0 === isAbove && (val = 1 - val), val === 0 ? PointInPolygonResult.IsOutside : PointInPolygonResult.IsInside);
  }
  InternalClipper2.pointInPolygon = pointInPolygon;
  function path2ContainsPath1(path1, path2) {
    let pip = PointInPolygonResult.IsOn;
    for (let pt of path1)
      switch (pointInPolygon(pt, path2)) {
        case PointInPolygonResult.IsOutside:
          if (pip === PointInPolygonResult.IsOutside)
            return !1;
          pip = PointInPolygonResult.IsOutside;
          break;
        case PointInPolygonResult.IsInside:
          if (pip === PointInPolygonResult.IsInside)
            return !0;
          pip = PointInPolygonResult.IsInside;
          break;
        default:
          break;
      }
    let mp = getBounds(path1), midPt = {
      x: Math.round((mp.left + mp.right) / 2),
      y: Math.round((mp.top + mp.bottom) / 2)
    };
    return pointInPolygon(midPt, path2) !== PointInPolygonResult.IsOutside;
  }
  InternalClipper2.path2ContainsPath1 = path2ContainsPath1;
})(InternalClipper || (InternalClipper = {}));
var Point64Utils;
(function(Point64Utils2) {
  function create(x = 0, y = 0, z = 0) {
    return { x: Math.round(x), y: Math.round(y), z };
  }
  Point64Utils2.create = create;
  function fromPointD(pt) {
    return { x: Math.round(pt.x), y: Math.round(pt.y), z: pt.z || 0 };
  }
  Point64Utils2.fromPointD = fromPointD;
  function scale(pt, scale2) {
    return {
      x: Math.round(pt.x * scale2),
      y: Math.round(pt.y * scale2),
      z: pt.z || 0
    };
  }
  Point64Utils2.scale = scale;
  function equals(a, b) {
    return a.x === b.x && a.y === b.y;
  }
  Point64Utils2.equals = equals;
  function add(a, b) {
    return { x: a.x + b.x, y: a.y + b.y, z: 0 };
  }
  Point64Utils2.add = add;
  function subtract(a, b) {
    return { x: a.x - b.x, y: a.y - b.y, z: 0 };
  }
  Point64Utils2.subtract = subtract;
  function toString(pt) {
    return pt.z !== void 0 && pt.z !== 0 ? `${pt.x},${pt.y},${pt.z} ` : `${pt.x},${pt.y} `;
  }
  Point64Utils2.toString = toString;
})(Point64Utils || (Point64Utils = {}));
var PointDUtils;
(function(PointDUtils2) {
  function create(x = 0, y = 0, z = 0) {
    return { x, y, z };
  }
  PointDUtils2.create = create;
  function fromPoint64(pt) {
    return { x: pt.x, y: pt.y, z: pt.z || 0 };
  }
  PointDUtils2.fromPoint64 = fromPoint64;
  function scale(pt, scale2) {
    return { x: pt.x * scale2, y: pt.y * scale2, z: pt.z || 0 };
  }
  PointDUtils2.scale = scale;
  function equals(a, b) {
    return InternalClipper.isAlmostZero(a.x - b.x) && InternalClipper.isAlmostZero(a.y - b.y);
  }
  PointDUtils2.equals = equals;
  function negate(pt) {
    pt.x = -pt.x, pt.y = -pt.y;
  }
  PointDUtils2.negate = negate;
  function toString(pt, precision = 2) {
    return pt.z !== void 0 && pt.z !== 0 ? `${pt.x.toFixed(precision)},${pt.y.toFixed(precision)},${pt.z}` : `${pt.x.toFixed(precision)},${pt.y.toFixed(precision)}`;
  }
  PointDUtils2.toString = toString;
})(PointDUtils || (PointDUtils = {}));
var Rect64Utils;
(function(Rect64Utils2) {
  function create(l = 0, t = 0, r = 0, b = 0) {
    return { left: l, top: t, right: r, bottom: b };
  }
  Rect64Utils2.create = create;
  function createInvalid() {
    return {
      left: Number.MAX_SAFE_INTEGER,
      top: Number.MAX_SAFE_INTEGER,
      right: Number.MIN_SAFE_INTEGER,
      bottom: Number.MIN_SAFE_INTEGER
    };
  }
  Rect64Utils2.createInvalid = createInvalid;
  function width(rect) {
    return rect.right - rect.left;
  }
  Rect64Utils2.width = width;
  function height(rect) {
    return rect.bottom - rect.top;
  }
  Rect64Utils2.height = height;
  function isEmpty(rect) {
    return rect.bottom <= rect.top || rect.right <= rect.left;
  }
  Rect64Utils2.isEmpty = isEmpty;
  function isValid(rect) {
    return rect.left < Number.MAX_SAFE_INTEGER;
  }
  Rect64Utils2.isValid = isValid;
  function midPoint(rect) {
    return {
      x: Math.round((rect.left + rect.right) / 2),
      y: Math.round((rect.top + rect.bottom) / 2)
    };
  }
  Rect64Utils2.midPoint = midPoint;
  function contains(rect, pt) {
    return pt.x > rect.left && pt.x < rect.right && pt.y > rect.top && pt.y < rect.bottom;
  }
  Rect64Utils2.contains = contains;
  function containsRect(rect, rec) {
    return rec.left >= rect.left && rec.right <= rect.right && rec.top >= rect.top && rec.bottom <= rect.bottom;
  }
  Rect64Utils2.containsRect = containsRect;
  function intersects(rect, rec) {
    return Math.max(rect.left, rec.left) <= Math.min(rect.right, rec.right) && Math.max(rect.top, rec.top) <= Math.min(rect.bottom, rec.bottom);
  }
  Rect64Utils2.intersects = intersects;
  function asPath(rect) {
    return [
      { x: rect.left, y: rect.top, z: 0 },
      { x: rect.right, y: rect.top, z: 0 },
      { x: rect.right, y: rect.bottom, z: 0 },
      { x: rect.left, y: rect.bottom, z: 0 }
    ];
  }
  Rect64Utils2.asPath = asPath;
})(Rect64Utils || (Rect64Utils = {}));
var RectDUtils;
(function(RectDUtils2) {
  function create(l = 0, t = 0, r = 0, b = 0) {
    return { left: l, top: t, right: r, bottom: b };
  }
  RectDUtils2.create = create;
  function createInvalid() {
    return {
      left: Number.MAX_VALUE,
      top: Number.MAX_VALUE,
      right: -Number.MAX_VALUE,
      bottom: -Number.MAX_VALUE
    };
  }
  RectDUtils2.createInvalid = createInvalid;
  function width(rect) {
    return rect.right - rect.left;
  }
  RectDUtils2.width = width;
  function height(rect) {
    return rect.bottom - rect.top;
  }
  RectDUtils2.height = height;
  function isEmpty(rect) {
    return rect.bottom <= rect.top || rect.right <= rect.left;
  }
  RectDUtils2.isEmpty = isEmpty;
  function midPoint(rect) {
    return {
      x: (rect.left + rect.right) / 2,
      y: (rect.top + rect.bottom) / 2
    };
  }
  RectDUtils2.midPoint = midPoint;
  function contains(rect, pt) {
    return pt.x > rect.left && pt.x < rect.right && pt.y > rect.top && pt.y < rect.bottom;
  }
  RectDUtils2.contains = contains;
  function containsRect(rect, rec) {
    return rec.left >= rect.left && rec.right <= rect.right && rec.top >= rect.top && rec.bottom <= rect.bottom;
  }
  RectDUtils2.containsRect = containsRect;
  function intersects(rect, rec) {
    return Math.max(rect.left, rec.left) < Math.min(rect.right, rec.right) && Math.max(rect.top, rec.top) < Math.min(rect.bottom, rec.bottom);
  }
  RectDUtils2.intersects = intersects;
  function asPath(rect) {
    return [
      { x: rect.left, y: rect.top, z: 0 },
      { x: rect.right, y: rect.top, z: 0 },
      { x: rect.right, y: rect.bottom, z: 0 },
      { x: rect.left, y: rect.bottom, z: 0 }
    ];
  }
  RectDUtils2.asPath = asPath;
})(RectDUtils || (RectDUtils = {}));
var PathUtils;
(function(PathUtils2) {
  function toString64(path) {
    let result = "";
    for (let pt of path)
      result += Point64Utils.toString(pt);
    return result + `
`;
  }
  PathUtils2.toString64 = toString64;
  function toStringD(path, precision = 2) {
    let result = "";
    for (let pt of path)
      result += PointDUtils.toString(pt, precision) + ", ";
    return result !== "" && (result = result.slice(0, -2)), result;
  }
  PathUtils2.toStringD = toStringD;
  function reverse64(path) {
    return [...path].reverse();
  }
  PathUtils2.reverse64 = reverse64;
  function reverseD(path) {
    return [...path].reverse();
  }
  PathUtils2.reverseD = reverseD;
})(PathUtils || (PathUtils = {}));
var PathsUtils;
(function(PathsUtils2) {
  function toString64(paths) {
    let result = "";
    for (let path of paths)
      result += PathUtils.toString64(path);
    return result;
  }
  PathsUtils2.toString64 = toString64;
  function toStringD(paths, precision = 2) {
    let result = "";
    for (let path of paths)
      result += PathUtils.toStringD(path, precision) + `
`;
    return result;
  }
  PathsUtils2.toStringD = toStringD;
  function reverse64(paths) {
    return paths.map((path) => PathUtils.reverse64(path));
  }
  PathsUtils2.reverse64 = reverse64;
  function reverseD(paths) {
    return paths.map((path) => PathUtils.reverseD(path));
  }
  PathsUtils2.reverseD = reverseD;
})(PathsUtils || (PathsUtils = {}));
var InvalidRect64 = Rect64Utils.createInvalid(), InvalidRectD = RectDUtils.createInvalid();

// node_modules/clipper2-ts/dist/Engine.js
var VertexFlags;
(function(VertexFlags2) {
  VertexFlags2[VertexFlags2.None = 0] = "None", VertexFlags2[VertexFlags2.OpenStart = 1] = "OpenStart", VertexFlags2[VertexFlags2.OpenEnd = 2] = "OpenEnd", VertexFlags2[VertexFlags2.LocalMax = 4] = "LocalMax", VertexFlags2[VertexFlags2.LocalMin = 8] = "LocalMin";
})(VertexFlags || (VertexFlags = {}));
var ScanlineHeap = class {
  data = [];
  push(value) {
    this.data.push(value), this.siftUp(this.data.length - 1);
  }
  pop() {
    if (this.data.length === 0)
      return null;
    let max = this.data[0], last = this.data.pop();
    return this.data.length > 0 && (this.data[0] = last, this.siftDown(0)), max;
  }
  clear() {
    this.data.length = 0;
  }
  siftUp(index) {
    for (; index > 0; ) {
      let parent = index - 1 >> 1;
      if (this.data[parent] >= this.data[index])
        break;
      [this.data[parent], this.data[index]] = [this.data[index], this.data[parent]], index = parent;
    }
  }
  siftDown(index) {
    let length = this.data.length;
    for (; ; ) {
      let largest = index, left = (index << 1) + 1, right = left + 1;
      if (left < length && this.data[left] > this.data[largest] && (largest = left), right < length && this.data[right] > this.data[largest] && (largest = right), largest === index)
        break;
      [this.data[index], this.data[largest]] = [this.data[largest], this.data[index]], index = largest;
    }
  }
}, Vertex = class {
  pt;
  next = null;
  prev = null;
  flags;
  constructor(pt, flags, prev) {
    this.pt = pt, this.flags = flags, this.prev = prev;
  }
}, LocalMinima = class {
  vertex;
  polytype;
  isOpen;
  constructor(vertex, polytype, isOpen = !1) {
    this.vertex = vertex, this.polytype = polytype, this.isOpen = isOpen;
  }
  equals(other) {
    return other !== null && this.vertex === other.vertex;
  }
};
function createIntersectNode(pt, edge1, edge2) {
  return { pt: { x: pt.x, y: pt.y, z: pt.z || 0 }, edge1, edge2 };
}
var OutPt = class _OutPt {
  static _nextId = 1;
  _debugId;
  pt;
  next;
  prev;
  outrec;
  horz;
  constructor(pt, outrec) {
    this._debugId = _OutPt._nextId++, this.pt = pt, this.outrec = outrec, this.next = this, this.prev = this, this.horz = null;
  }
}, JoinWith;
(function(JoinWith2) {
  JoinWith2[JoinWith2.None = 0] = "None", JoinWith2[JoinWith2.Left = 1] = "Left", JoinWith2[JoinWith2.Right = 2] = "Right";
})(JoinWith || (JoinWith = {}));
var HorzPosition;
(function(HorzPosition2) {
  HorzPosition2[HorzPosition2.Bottom = 0] = "Bottom", HorzPosition2[HorzPosition2.Middle = 1] = "Middle", HorzPosition2[HorzPosition2.Top = 2] = "Top";
})(HorzPosition || (HorzPosition = {}));
var OutRec = class _OutRec {
  static _nextId = 1;
  _debugId;
  idx = 0;
  owner = null;
  frontEdge = null;
  backEdge = null;
  pts = null;
  polypath = null;
  bounds = { left: 0, top: 0, right: 0, bottom: 0 };
  path = [];
  isOpen = !1;
  splits = null;
  recursiveSplit = null;
  constructor() {
    this._debugId = _OutRec._nextId++;
  }
}, HorzSegment = class {
  leftOp;
  rightOp;
  leftToRight;
  constructor(op) {
    this.leftOp = op, this.rightOp = null, this.leftToRight = !0;
  }
}, HorzJoin = class {
  op1;
  op2;
  constructor(ltor, rtol) {
    this.op1 = ltor, this.op2 = rtol;
  }
}, Active = class {
  bot = { x: 0, y: 0, z: 0 };
  top = { x: 0, y: 0, z: 0 };
  curX = 0;
  // current (updated at every new scanline) - keep as number but ensure integer precision
  dx = 0;
  windDx = 0;
  // 1 or -1 depending on winding direction
  windCount = 0;
  windCount2 = 0;
  // winding count of the opposite polytype
  outrec = null;
  // AEL: 'active edge list' (Vatti's AET - active edge table)
  //     a linked list of all edges (from left to right) that are present
  //     (or 'active') within the current scanbeam (a horizontal 'beam' that
  //     sweeps from bottom to top over the paths in the clipping operation).
  prevInAEL = null;
  nextInAEL = null;
  // SEL: 'sorted edge list' (Vatti's ST - sorted table)
  //     linked list used when sorting edges into their new positions at the
  //     top of scanbeams, but also (re)used to process horizontals.
  prevInSEL = null;
  nextInSEL = null;
  jump = null;
  vertexTop = null;
  localMin = null;
  // the bottom of an edge 'bound' (also Vatti)
  isLeftBound = !1;
  joinWith = JoinWith.None;
}, ClipperEngine;
(function(ClipperEngine2) {
  function addLocMin(vert, polytype, isOpen, minimaList) {
    if ((vert.flags & VertexFlags.LocalMin) !== VertexFlags.None)
      return;
    vert.flags |= VertexFlags.LocalMin;
    let lm = new LocalMinima(vert, polytype, isOpen);
    minimaList.push(lm);
  }
  ClipperEngine2.addLocMin = addLocMin;
  function addPathsToVertexList(paths, polytype, isOpen, minimaList, vertexList) {
    for (let i = 0, len = paths.length; i < len; i++) {
      let path = paths[i], v0 = null, prevV = null;
      for (let j = 0, len2 = path.length; j < len2; j++) {
        let pt = path[j];
        if (v0 === null)
          v0 = new Vertex(pt, VertexFlags.None, null), vertexList.push(v0), prevV = v0;
        else if (!(prevV.pt.x === pt.x && prevV.pt.y === pt.y)) {
          let currV2 = new Vertex(pt, VertexFlags.None, prevV);
          vertexList.push(currV2), prevV.next = currV2, prevV = currV2;
        }
      }
      if (prevV?.prev === null || (!isOpen && prevV.pt.x === v0.pt.x && prevV.pt.y === v0.pt.y && (prevV = prevV.prev), prevV.next = v0, v0.prev = prevV, !isOpen && prevV.next === prevV))
        continue;
      let goingUp;
      if (isOpen) {
        let currV2 = v0.next;
        for (; currV2 !== v0 && currV2.pt.y === v0.pt.y; )
          currV2 = currV2.next;
        goingUp = currV2.pt.y <= v0.pt.y, goingUp ? (v0.flags = VertexFlags.OpenStart, addLocMin(v0, polytype, !0, minimaList)) : v0.flags = VertexFlags.OpenStart | VertexFlags.LocalMax;
      } else {
        for (prevV = v0.prev; prevV !== v0 && prevV.pt.y === v0.pt.y; )
          prevV = prevV.prev;
        if (prevV === v0)
          continue;
        goingUp = prevV.pt.y > v0.pt.y;
      }
      let goingUp0 = goingUp;
      prevV = v0;
      let currV = v0.next;
      for (; currV !== v0; )
        currV.pt.y > prevV.pt.y && goingUp ? (prevV.flags |= VertexFlags.LocalMax, goingUp = !1) : currV.pt.y < prevV.pt.y && !goingUp && (goingUp = !0, addLocMin(prevV, polytype, isOpen, minimaList)), prevV = currV, currV = currV.next;
      isOpen ? (prevV.flags |= VertexFlags.OpenEnd, goingUp ? prevV.flags |= VertexFlags.LocalMax : addLocMin(prevV, polytype, isOpen, minimaList)) : goingUp !== goingUp0 && (goingUp0 ? addLocMin(prevV, polytype, !1, minimaList) : prevV.flags |= VertexFlags.LocalMax);
    }
  }
  ClipperEngine2.addPathsToVertexList = addPathsToVertexList;
})(ClipperEngine || (ClipperEngine = {}));
var ClipperBase = class _ClipperBase {
  cliptype = ClipType.NoClip;
  fillrule = FillRule.EvenOdd;
  actives = null;
  sel = null;
  minimaList = [];
  intersectList = [];
  vertexList = [];
  outrecList = [];
  scanlineHeap = new ScanlineHeap();
  scanlineSet = /* @__PURE__ */ new Set();
  // For very small inputs, a heap + set can cost more than it saves.
  // Use an array-based scanline mode initially, and upgrade to heap+set
  // automatically if the scanline list grows beyond a threshold.
  scanlineArr = [];
  useScanlineArray = !1;
  horzSegList = [];
  horzJoinList = [];
  currentLocMin = 0;
  currentBotY = 0;
  isSortedMinimaList = !1;
  hasOpenPaths = !1;
  usingPolytree = !1;
  succeeded = !1;
  preserveCollinear = !0;
  reverseSolution = !1;
  constructor() {
  }
  // Z-coordinate callback support
  // Override in subclasses (Clipper64/ClipperD) to provide callback
  getZCallback() {
  }
  xyEqual(pt1, pt2) {
    return pt1.x === pt2.x && pt1.y === pt2.y;
  }
  setZ(ae1, ae2, intersectPt) {
    let zCallback = this.getZCallback();
    zCallback && (_ClipperBase.getPolyType(ae1) === PathType.Subject ? (this.xyEqual(intersectPt, ae1.bot) ? intersectPt.z = ae1.bot.z : this.xyEqual(intersectPt, ae1.top) ? intersectPt.z = ae1.top.z : this.xyEqual(intersectPt, ae2.bot) ? intersectPt.z = ae2.bot.z : this.xyEqual(intersectPt, ae2.top) ? intersectPt.z = ae2.top.z : intersectPt.z = 0, zCallback(ae1.bot, ae1.top, ae2.bot, ae2.top, intersectPt)) : (this.xyEqual(intersectPt, ae2.bot) ? intersectPt.z = ae2.bot.z : this.xyEqual(intersectPt, ae2.top) ? intersectPt.z = ae2.top.z : this.xyEqual(intersectPt, ae1.bot) ? intersectPt.z = ae1.bot.z : this.xyEqual(intersectPt, ae1.top) ? intersectPt.z = ae1.top.z : intersectPt.z = 0, zCallback(ae2.bot, ae2.top, ae1.bot, ae1.top, intersectPt)));
  }
  // Helper functions
  static isOdd(val) {
    return (val & 1) !== 0;
  }
  static isHotEdge(ae) {
    return ae.outrec != null;
  }
  static isOpen(ae) {
    return ae.localMin.isOpen;
  }
  static isOpenEnd(ae) {
    return ae.localMin.isOpen && _ClipperBase.isOpenEndVertex(ae.vertexTop);
  }
  static isOpenEndVertex(v) {
    return (v.flags & (VertexFlags.OpenStart | VertexFlags.OpenEnd)) !== VertexFlags.None;
  }
  static getPrevHotEdge(ae) {
    let prev = ae.prevInAEL;
    for (; prev !== null && (_ClipperBase.isOpen(prev) || !_ClipperBase.isHotEdge(prev)); )
      prev = prev.prevInAEL;
    return prev;
  }
  static isFront(ae) {
    return ae === ae.outrec.frontEdge;
  }
  /*******************************************************************************
  *  Dx:                             0(90deg)                                    *
  *                                  |                                           *
  *               +inf (180deg) <--- o ---> -inf (0deg)                          *
  *******************************************************************************/
  static getDx(pt1, pt2) {
    let dy = pt2.y - pt1.y;
    return dy !== 0 ? (pt2.x - pt1.x) / dy : pt2.x > pt1.x ? Number.NEGATIVE_INFINITY : Number.POSITIVE_INFINITY;
  }
  static topX(ae, currentY) {
    return currentY === ae.top.y || ae.top.x === ae.bot.x ? ae.top.x : currentY === ae.bot.y ? ae.bot.x : InternalClipper.roundToEven(ae.bot.x + ae.dx * (currentY - ae.bot.y));
  }
  static isHorizontal(ae) {
    return ae.top.y === ae.bot.y;
  }
  static isHeadingRightHorz(ae) {
    return ae.dx === Number.NEGATIVE_INFINITY;
  }
  static isHeadingLeftHorz(ae) {
    return ae.dx === Number.POSITIVE_INFINITY;
  }
  static swapActives(ae1, ae2) {
    return [ae2, ae1];
  }
  static getPolyType(ae) {
    return ae.localMin.polytype;
  }
  static isSamePolyType(ae1, ae2) {
    return ae1.localMin.polytype === ae2.localMin.polytype;
  }
  static setDx(ae) {
    ae.dx = _ClipperBase.getDx(ae.bot, ae.top);
  }
  static nextVertex(ae) {
    return ae.windDx > 0 ? ae.vertexTop.next : ae.vertexTop.prev;
  }
  static prevPrevVertex(ae) {
    return ae.windDx > 0 ? ae.vertexTop.prev.prev : ae.vertexTop.next.next;
  }
  static isMaxima(vertexOrAe) {
    return "flags" in vertexOrAe ? (vertexOrAe.flags & VertexFlags.LocalMax) !== VertexFlags.None : _ClipperBase.isMaxima(vertexOrAe.vertexTop);
  }
  static getMaximaPair(ae) {
    let ae2 = ae.nextInAEL;
    for (; ae2 !== null; ) {
      if (ae2.vertexTop === ae.vertexTop)
        return ae2;
      ae2 = ae2.nextInAEL;
    }
    return null;
  }
  // optimization (not in C# reference): fast bounding box overlap check for segment intersection
  boundingBoxesOverlap(p1, p2, p3, p4) {
    let min1x = Math.min(p1.x, p2.x), max1x = Math.max(p1.x, p2.x), min1y = Math.min(p1.y, p2.y), max1y = Math.max(p1.y, p2.y), min2x = Math.min(p3.x, p4.x), max2x = Math.max(p3.x, p4.x), min2y = Math.min(p3.y, p4.y), max2y = Math.max(p3.y, p4.y);
    return !(max1x < min2x || max2x < min1x || max1y < min2y || max2y < min1y);
  }
  clearSolutionOnly() {
    for (; this.actives !== null; )
      this.deleteFromAEL(this.actives);
    this.scanlineHeap.clear(), this.scanlineSet.clear(), this.scanlineArr.length = 0, this.disposeIntersectNodes(), this.outrecList.length = 0, this.horzSegList.length = 0, this.horzJoinList.length = 0;
  }
  clear() {
    this.clearSolutionOnly(), this.minimaList.length = 0, this.vertexList.length = 0, this.currentLocMin = 0, this.isSortedMinimaList = !1, this.hasOpenPaths = !1;
  }
  reset() {
    this.isSortedMinimaList || (this.minimaList.sort((a, b) => b.vertex.pt.y - a.vertex.pt.y), this.isSortedMinimaList = !0), this.scanlineHeap.clear(), this.scanlineSet.clear(), this.scanlineArr.length = 0, this.useScanlineArray = this.minimaList.length <= 16;
    for (let i = this.minimaList.length - 1; i >= 0; i--)
      this.insertScanline(this.minimaList[i].vertex.pt.y);
    this.currentBotY = 0, this.currentLocMin = 0, this.actives = null, this.sel = null, this.succeeded = !0;
  }
  upgradeScanlineStructureFromArray() {
    let arr = this.scanlineArr;
    for (let i = 0, len = arr.length; i < len; i++) {
      let y = arr[i];
      this.scanlineSet.add(y), this.scanlineHeap.push(y);
    }
    arr.length = 0, this.useScanlineArray = !1;
  }
  insertScanline(y) {
    if (this.useScanlineArray) {
      let arr = this.scanlineArr;
      for (let i = 0, len = arr.length; i < len; i++)
        if (arr[i] === y)
          return;
      arr.push(y), arr.length > 64 && this.upgradeScanlineStructureFromArray();
      return;
    }
    this.scanlineSet.has(y) || (this.scanlineSet.add(y), this.scanlineHeap.push(y));
  }
  popScanline() {
    if (this.useScanlineArray) {
      let arr = this.scanlineArr, len = arr.length;
      if (len === 0)
        return { success: !1, y: 0 };
      let bestIdx = 0, bestY = arr[0];
      for (let i = 1; i < len; i++) {
        let v = arr[i];
        v > bestY && (bestY = v, bestIdx = i);
      }
      return arr[bestIdx] = arr[len - 1], arr.pop(), { success: !0, y: bestY };
    }
    let y = this.scanlineHeap.pop();
    return y === null ? { success: !1, y: 0 } : (this.scanlineSet.delete(y), { success: !0, y });
  }
  hasLocMinAtY(y) {
    return this.currentLocMin < this.minimaList.length && this.minimaList[this.currentLocMin].vertex.pt.y === y;
  }
  popLocalMinima() {
    return this.minimaList[this.currentLocMin++];
  }
  addPath(path, polytype, isOpen = !1) {
    let tmp = [path];
    this.addPaths(tmp, polytype, isOpen);
  }
  addPaths(paths, polytype, isOpen = !1) {
    isOpen && (this.hasOpenPaths = !0), this.isSortedMinimaList = !1, ClipperEngine.addPathsToVertexList(paths, polytype, isOpen, this.minimaList, this.vertexList);
  }
  addReuseableData(reuseableData) {
    if (reuseableData.minimaList.length !== 0) {
      this.isSortedMinimaList = !1;
      for (let lm of reuseableData.minimaList)
        this.minimaList.push(new LocalMinima(lm.vertex, lm.polytype, lm.isOpen)), lm.isOpen && (this.hasOpenPaths = !0);
    }
  }
  deleteFromAEL(ae) {
    let prev = ae.prevInAEL, next = ae.nextInAEL;
    prev === null && next === null && ae !== this.actives || (prev !== null ? prev.nextInAEL = next : this.actives = next, next !== null && (next.prevInAEL = prev));
  }
  getBounds() {
    let bounds = {
      left: Number.MAX_SAFE_INTEGER,
      top: Number.MAX_SAFE_INTEGER,
      right: Number.MIN_SAFE_INTEGER,
      bottom: Number.MIN_SAFE_INTEGER
    };
    for (let t of this.vertexList) {
      let v = t;
      do
        v.pt.x < bounds.left && (bounds.left = v.pt.x), v.pt.x > bounds.right && (bounds.right = v.pt.x), v.pt.y < bounds.top && (bounds.top = v.pt.y), v.pt.y > bounds.bottom && (bounds.bottom = v.pt.y), v = v.next;
      while (v !== t);
    }
    return Rect64Utils.isEmpty(bounds) ? { left: 0, top: 0, right: 0, bottom: 0 } : bounds;
  }
  executeInternal(ct, fillRule) {
    if (ct === ClipType.NoClip)
      return;
    this.fillrule = fillRule, this.cliptype = ct, this.reset();
    let scanResult = this.popScanline();
    if (!scanResult.success)
      return;
    let y = scanResult.y;
    for (; this.succeeded; ) {
      this.insertLocalMinimaIntoAEL(y);
      let ae;
      for (; (ae = this.popHorz()) !== null; )
        this.doHorizontal(ae);
      this.horzSegList.length > 0 && (this.convertHorzSegsToJoins(), this.horzSegList.length = 0), this.currentBotY = y;
      let nextScanResult = this.popScanline();
      if (!nextScanResult.success)
        break;
      for (y = nextScanResult.y, this.doIntersections(y), this.doTopOfScanbeam(y); (ae = this.popHorz()) !== null; )
        this.doHorizontal(ae);
    }
    this.succeeded && this.processHorzJoins();
  }
  insertLocalMinimaIntoAEL(botY) {
    for (; this.hasLocMinAtY(botY); ) {
      let localMinima = this.popLocalMinima(), leftBound;
      (localMinima.vertex.flags & VertexFlags.OpenStart) !== VertexFlags.None ? leftBound = null : (leftBound = new Active(), leftBound.bot = { x: localMinima.vertex.pt.x, y: localMinima.vertex.pt.y, z: localMinima.vertex.pt.z || 0 }, leftBound.curX = localMinima.vertex.pt.x, leftBound.windDx = -1, leftBound.vertexTop = localMinima.vertex.prev, leftBound.top = { x: localMinima.vertex.prev.pt.x, y: localMinima.vertex.prev.pt.y, z: localMinima.vertex.prev.pt.z || 0 }, leftBound.outrec = null, leftBound.localMin = localMinima, _ClipperBase.setDx(leftBound));
      let rightBound;
      (localMinima.vertex.flags & VertexFlags.OpenEnd) !== VertexFlags.None ? rightBound = null : (rightBound = new Active(), rightBound.bot = { x: localMinima.vertex.pt.x, y: localMinima.vertex.pt.y, z: localMinima.vertex.pt.z || 0 }, rightBound.curX = localMinima.vertex.pt.x, rightBound.windDx = 1, rightBound.vertexTop = localMinima.vertex.next, rightBound.top = { x: localMinima.vertex.next.pt.x, y: localMinima.vertex.next.pt.y, z: localMinima.vertex.next.pt.z || 0 }, rightBound.outrec = null, rightBound.localMin = localMinima, _ClipperBase.setDx(rightBound)), leftBound !== null && rightBound !== null ? _ClipperBase.isHorizontal(leftBound) ? _ClipperBase.isHeadingRightHorz(leftBound) && ([leftBound, rightBound] = _ClipperBase.swapActives(leftBound, rightBound)) : _ClipperBase.isHorizontal(rightBound) ? _ClipperBase.isHeadingLeftHorz(rightBound) && ([leftBound, rightBound] = _ClipperBase.swapActives(leftBound, rightBound)) : leftBound.dx < rightBound.dx && ([leftBound, rightBound] = _ClipperBase.swapActives(leftBound, rightBound)) : leftBound === null && (leftBound = rightBound, rightBound = null);
      let contributing;
      if (leftBound.isLeftBound = !0, this.insertLeftEdge(leftBound), _ClipperBase.isOpen(leftBound) ? (this.setWindCountForOpenPathEdge(leftBound), contributing = this.isContributingOpen(leftBound)) : (this.setWindCountForClosedPathEdge(leftBound), contributing = this.isContributingClosed(leftBound)), rightBound !== null) {
        for (rightBound.windCount = leftBound.windCount, rightBound.windCount2 = leftBound.windCount2, this.insertRightEdge(leftBound, rightBound), contributing && (this.addLocalMinPoly(leftBound, rightBound, leftBound.bot, !0), _ClipperBase.isHorizontal(leftBound) || this.checkJoinLeft(leftBound, leftBound.bot)); rightBound.nextInAEL !== null && this.isValidAelOrder(rightBound.nextInAEL, rightBound); )
          this.intersectEdges(rightBound, rightBound.nextInAEL, rightBound.bot), this.swapPositionsInAEL(rightBound, rightBound.nextInAEL);
        _ClipperBase.isHorizontal(rightBound) ? this.pushHorz(rightBound) : (this.checkJoinRight(rightBound, rightBound.bot), this.insertScanline(rightBound.top.y));
      } else contributing && this.startOpenPath(leftBound, leftBound.bot);
      _ClipperBase.isHorizontal(leftBound) ? this.pushHorz(leftBound) : this.insertScanline(leftBound.top.y);
    }
  }
  pushHorz(ae) {
    ae.nextInSEL = this.sel, this.sel = ae;
  }
  popHorz() {
    let ae = this.sel;
    return ae === null ? null : (this.sel = this.sel.nextInSEL, ae);
  }
  doHorizontal(horz) {
    let horzIsOpen = _ClipperBase.isOpen(horz), y = horz.bot.y, vertexMax = horzIsOpen ? this.getCurrYMaximaVertexOpen(horz) : this.getCurrYMaximaVertex(horz), { isLeftToRight, leftX, rightX } = this.resetHorzDirection(horz, vertexMax), leftX2 = leftX, rightX2 = rightX;
    if (_ClipperBase.isHotEdge(horz)) {
      let op = this.addOutPt(horz, { x: horz.curX, y });
      this.addToHorzSegList(op);
    }
    for (; ; ) {
      let ae = isLeftToRight ? horz.nextInAEL : horz.prevInAEL;
      for (; ae !== null; ) {
        if (ae.vertexTop === vertexMax) {
          if (_ClipperBase.isHotEdge(horz) && this.isJoined(ae) && this.split(ae, ae.top), _ClipperBase.isHotEdge(horz)) {
            for (; horz.vertexTop !== vertexMax; )
              this.addOutPt(horz, horz.top), this.updateEdgeIntoAEL(horz);
            isLeftToRight ? this.addLocalMaxPoly(horz, ae, horz.top) : this.addLocalMaxPoly(ae, horz, horz.top);
          }
          this.deleteFromAEL(ae), this.deleteFromAEL(horz);
          return;
        }
        if (vertexMax !== horz.vertexTop || _ClipperBase.isOpenEnd(horz)) {
          if (isLeftToRight && ae.curX > rightX2 || !isLeftToRight && ae.curX < leftX2)
            break;
          if (ae.curX === horz.top.x && !_ClipperBase.isHorizontal(ae)) {
            let pt2 = _ClipperBase.nextVertex(horz).pt;
            if (_ClipperBase.isOpen(ae) && !_ClipperBase.isSamePolyType(ae, horz) && !_ClipperBase.isHotEdge(ae)) {
              if (isLeftToRight && _ClipperBase.topX(ae, pt2.y) > pt2.x || !isLeftToRight && _ClipperBase.topX(ae, pt2.y) < pt2.x)
                break;
            } else if (isLeftToRight && _ClipperBase.topX(ae, pt2.y) >= pt2.x || !isLeftToRight && _ClipperBase.topX(ae, pt2.y) <= pt2.x)
              break;
          }
        }
        let pt = { x: ae.curX, y };
        isLeftToRight ? (this.intersectEdges(horz, ae, pt), this.swapPositionsInAEL(horz, ae), this.checkJoinLeft(ae, pt), horz.curX = ae.curX, ae = horz.nextInAEL) : (this.intersectEdges(ae, horz, pt), this.swapPositionsInAEL(ae, horz), this.checkJoinRight(ae, pt), horz.curX = ae.curX, ae = horz.prevInAEL), _ClipperBase.isHotEdge(horz) && this.addToHorzSegList(this.getLastOp(horz));
      }
      if (horzIsOpen && _ClipperBase.isOpenEnd(horz)) {
        _ClipperBase.isHotEdge(horz) && (this.addOutPt(horz, horz.top), _ClipperBase.isFront(horz) ? horz.outrec.frontEdge = null : horz.outrec.backEdge = null, horz.outrec = null), this.deleteFromAEL(horz);
        return;
      }
      if (_ClipperBase.nextVertex(horz).pt.y !== horz.top.y)
        break;
      _ClipperBase.isHotEdge(horz) && this.addOutPt(horz, horz.top), this.updateEdgeIntoAEL(horz);
      let resetResult = this.resetHorzDirection(horz, vertexMax);
      leftX2 = resetResult.leftX, rightX2 = resetResult.rightX;
    }
    if (_ClipperBase.isHotEdge(horz)) {
      let op = this.addOutPt(horz, horz.top);
      this.addToHorzSegList(op);
    }
    this.updateEdgeIntoAEL(horz);
  }
  convertHorzSegsToJoins() {
    let k = 0;
    for (let hs of this.horzSegList)
      this.updateHorzSegment(hs) && k++;
    if (!(k < 2)) {
      this.horzSegList.sort((a, b) => this.horzSegSort(a, b));
      for (let i = 0; i < k - 1; i++) {
        let hs1 = this.horzSegList[i];
        for (let j = i + 1; j < k; j++) {
          let hs2 = this.horzSegList[j];
          if (hs2.leftOp.pt.x >= hs1.rightOp.pt.x || hs2.leftToRight === hs1.leftToRight || hs2.rightOp.pt.x <= hs1.leftOp.pt.x)
            continue;
          let currY = hs1.leftOp.pt.y;
          if (hs1.leftToRight) {
            for (; hs1.leftOp.next.pt.y === currY && hs1.leftOp.next.pt.x <= hs2.leftOp.pt.x; )
              hs1.leftOp = hs1.leftOp.next;
            for (; hs2.leftOp.prev.pt.y === currY && hs2.leftOp.prev.pt.x <= hs1.leftOp.pt.x; )
              hs2.leftOp = hs2.leftOp.prev;
            let join = new HorzJoin(this.duplicateOp(hs1.leftOp, !0), this.duplicateOp(hs2.leftOp, !1));
            this.horzJoinList.push(join);
          } else {
            for (; hs1.leftOp.prev.pt.y === currY && hs1.leftOp.prev.pt.x <= hs2.leftOp.pt.x; )
              hs1.leftOp = hs1.leftOp.prev;
            for (; hs2.leftOp.next.pt.y === currY && hs2.leftOp.next.pt.x <= hs1.leftOp.pt.x; )
              hs2.leftOp = hs2.leftOp.next;
            let join = new HorzJoin(this.duplicateOp(hs2.leftOp, !0), this.duplicateOp(hs1.leftOp, !1));
            this.horzJoinList.push(join);
          }
        }
      }
    }
  }
  updateHorzSegment(hs) {
    let op = hs.leftOp, outrec = this.getRealOutRec(op.outrec), outrecHasEdges = outrec.frontEdge !== null, currY = op.pt.y, opP = op, opN = op;
    if (outrecHasEdges) {
      let opA = outrec.pts, opZ = opA.next;
      for (; opP !== opZ && opP.prev.pt.y === currY; )
        opP = opP.prev;
      for (; opN !== opA && opN.next.pt.y === currY; )
        opN = opN.next;
    } else {
      for (; opP.prev !== opN && opP.prev.pt.y === currY; )
        opP = opP.prev;
      for (; opN.next !== opP && opN.next.pt.y === currY; )
        opN = opN.next;
    }
    let result = this.setHorzSegHeadingForward(hs, opP, opN) && hs.leftOp.horz === null;
    return result ? hs.leftOp.horz = hs : hs.rightOp = null, result;
  }
  setHorzSegHeadingForward(hs, opP, opN) {
    return opP.pt.x === opN.pt.x ? !1 : (opP.pt.x < opN.pt.x ? (hs.leftOp = opP, hs.rightOp = opN, hs.leftToRight = !0) : (hs.leftOp = opN, hs.rightOp = opP, hs.leftToRight = !1), !0);
  }
  horzSegSort(hs1, hs2) {
    return hs1.rightOp === null ? hs2.rightOp === null ? 0 : 1 : hs2.rightOp === null ? -1 : hs1.leftOp.pt.x - hs2.leftOp.pt.x;
  }
  duplicateOp(op, insertAfter) {
    let result = new OutPt(op.pt, op.outrec);
    return insertAfter ? (result.next = op.next, result.next.prev = result, result.prev = op, op.next = result) : (result.prev = op.prev, result.prev.next = result, result.next = op, op.prev = result), result;
  }
  getRealOutRec(outRec) {
    for (; outRec !== null && outRec.pts === null; )
      outRec = outRec.owner;
    return outRec;
  }
  doIntersections(y) {
    this.buildIntersectList(y) && (this.processIntersectList(), this.disposeIntersectNodes());
  }
  doTopOfScanbeam(y) {
    this.sel = null;
    let ae = this.actives;
    for (; ae !== null; ) {
      if (ae.top.y === y)
        if (ae.curX = ae.top.x, _ClipperBase.isMaxima(ae)) {
          ae = this.doMaxima(ae);
          continue;
        } else
          _ClipperBase.isHotEdge(ae) && this.addOutPt(ae, ae.top), this.updateEdgeIntoAEL(ae), _ClipperBase.isHorizontal(ae) && this.pushHorz(ae);
      else
        ae.curX = _ClipperBase.topX(ae, y);
      ae = ae.nextInAEL;
    }
  }
  processHorzJoins() {
    for (let j of this.horzJoinList) {
      let or1 = this.getRealOutRec(j.op1.outrec), or2 = this.getRealOutRec(j.op2.outrec), op1b = j.op1.next, op2b = j.op2.prev;
      if (j.op1.next = j.op2, j.op2.prev = j.op1, op1b.prev = op2b, op2b.next = op1b, or1 === or2) {
        let or2New = this.newOutRec();
        or2New.pts = op1b, this.fixOutRecPts(or2New), or1.pts.outrec === or2New && (or1.pts = j.op1, or1.pts.outrec = or1), this.usingPolytree ? (this.path1InsidePath2(or1.pts, or2New.pts) ? ([or2New.pts, or1.pts] = [or1.pts, or2New.pts], this.fixOutRecPts(or1), this.fixOutRecPts(or2New), or2New.owner = or1) : this.path1InsidePath2(or2New.pts, or1.pts) ? or2New.owner = or1 : or2New.owner = or1.owner, or1.splits === null && (or1.splits = []), or1.splits.push(or2New.idx)) : or2New.owner = or1;
      } else
        or2.pts = null, this.usingPolytree ? (this.setOwner(or2, or1), this.moveSplits(or2, or1)) : or2.owner = or1;
    }
  }
  fixOutRecPts(outrec) {
    let op = outrec.pts;
    do
      op.outrec = outrec, op = op.next;
    while (op !== outrec.pts);
  }
  path1InsidePath2(op1, op2) {
    let pip = PointInPolygonResult.IsOn, op = op1;
    do {
      switch (this.pointInOpPolygon(op.pt, op2)) {
        case PointInPolygonResult.IsOutside:
          if (pip === PointInPolygonResult.IsOutside)
            return !1;
          pip = PointInPolygonResult.IsOutside;
          break;
        case PointInPolygonResult.IsInside:
          if (pip === PointInPolygonResult.IsInside)
            return !0;
          pip = PointInPolygonResult.IsInside;
          break;
        default:
          break;
      }
      op = op.next;
    } while (op !== op1);
    return InternalClipper.path2ContainsPath1(this.getCleanPath(op1), this.getCleanPath(op2));
  }
  pointInOpPolygon(pt, op) {
    if (op === op.next || op.prev === op.next)
      return PointInPolygonResult.IsOutside;
    let op2 = op;
    do {
      if (op.pt.y !== pt.y)
        break;
      op = op.next;
    } while (op !== op2);
    if (op.pt.y === pt.y)
      return PointInPolygonResult.IsOutside;
    let isAbove = op.pt.y < pt.y, startingAbove = isAbove, val = 0;
    for (op2 = op.next; op2 !== op; ) {
      if (isAbove)
        for (; op2 !== op && op2.pt.y < pt.y; )
          op2 = op2.next;
      else
        for (; op2 !== op && op2.pt.y > pt.y; )
          op2 = op2.next;
      if (op2 === op)
        break;
      if (op2.pt.y === pt.y) {
        if (op2.pt.x === pt.x || op2.pt.y === op2.prev.pt.y && pt.x < op2.prev.pt.x != pt.x < op2.pt.x)
          return PointInPolygonResult.IsOn;
        if (op2 = op2.next, op2 === op)
          break;
        continue;
      }
      if (op2.pt.x <= pt.x || op2.prev.pt.x <= pt.x)
        if (op2.prev.pt.x < pt.x && op2.pt.x < pt.x)
          val = 1 - val;
        else {
          let d = InternalClipper.crossProduct(op2.prev.pt, op2.pt, pt);
          if (d === 0)
            return PointInPolygonResult.IsOn;
          d < 0 === isAbove && (val = 1 - val);
        }
      isAbove = !isAbove, op2 = op2.next;
    }
    if (isAbove === startingAbove)
      return val === 0 ? PointInPolygonResult.IsOutside : PointInPolygonResult.IsInside;
    {
      let d = InternalClipper.crossProduct(op2.prev.pt, op2.pt, pt);
      if (d === 0)
        return PointInPolygonResult.IsOn;
      d < 0 === isAbove && (val = 1 - val);
    }
    return val === 0 ? PointInPolygonResult.IsOutside : PointInPolygonResult.IsInside;
  }
  getCleanPath(op) {
    let result = [], op2 = op;
    for (; op2.next !== op && (op2.pt.x === op2.next.pt.x && op2.pt.x === op2.prev.pt.x || op2.pt.y === op2.next.pt.y && op2.pt.y === op2.prev.pt.y); )
      op2 = op2.next;
    result.push(op2.pt);
    let prevOp = op2;
    for (op2 = op2.next; op2 !== op; )
      (op2.pt.x !== op2.next.pt.x || op2.pt.x !== prevOp.pt.x) && (op2.pt.y !== op2.next.pt.y || op2.pt.y !== prevOp.pt.y) && (result.push(op2.pt), prevOp = op2), op2 = op2.next;
    return result;
  }
  moveSplits(fromOr, toOr) {
    if (fromOr.splits !== null) {
      toOr.splits === null && (toOr.splits = []);
      for (let i of fromOr.splits)
        i !== toOr.idx && toOr.splits.push(i);
      fromOr.splits = null;
    }
  }
  buildIntersectList(topY) {
    if (this.actives?.nextInAEL === null)
      return !1;
    this.adjustCurrXAndCopyToSEL(topY);
    let left = this.sel;
    for (; left !== null && left.jump !== null; ) {
      let prevBase = null;
      for (; left !== null && left.jump !== null; ) {
        let currBase = left, right = left.jump, lEnd = right, rEnd = right?.jump || null;
        for (left.jump = rEnd; left !== lEnd && right !== rEnd; )
          if (right.curX < left.curX) {
            let tmp = right.prevInSEL;
            for (; this.addNewIntersectNode(tmp, right, topY), tmp !== left; )
              tmp = tmp.prevInSEL;
            if (tmp = right, right = this.extractFromSEL(tmp), lEnd = right, left !== null && this.insert1Before2InSEL(tmp, left), left !== currBase)
              continue;
            currBase = tmp, currBase.jump = rEnd, prevBase === null ? this.sel = currBase : prevBase.jump = currBase;
          } else
            left = left.nextInSEL;
        prevBase = currBase, left = rEnd;
      }
      left = this.sel;
    }
    return this.intersectList.length > 0;
  }
  processIntersectList() {
    this.intersectList.sort((a, b) => a.pt.y !== b.pt.y ? a.pt.y > b.pt.y ? -1 : 1 : a.pt.x !== b.pt.x ? a.pt.x < b.pt.x ? -1 : 1 : a.edge1.curX !== b.edge1.curX ? a.edge1.curX < b.edge1.curX ? -1 : 1 : a.edge2.curX < b.edge2.curX ? -1 : a.edge2.curX > b.edge2.curX ? 1 : 0);
    for (let i = 0; i < this.intersectList.length; ++i) {
      if (!this.edgesAdjacentInAEL(this.intersectList[i])) {
        let j = i + 1;
        for (; !this.edgesAdjacentInAEL(this.intersectList[j]); )
          j++;
        [this.intersectList[j], this.intersectList[i]] = [this.intersectList[i], this.intersectList[j]];
      }
      let node = this.intersectList[i];
      this.intersectEdges(node.edge1, node.edge2, node.pt), this.swapPositionsInAEL(node.edge1, node.edge2), node.edge1.curX = node.pt.x, node.edge2.curX = node.pt.x, this.checkJoinLeft(node.edge2, node.pt, !0), this.checkJoinRight(node.edge1, node.pt, !0);
    }
  }
  edgesAdjacentInAEL(inode) {
    return inode.edge1.nextInAEL === inode.edge2 || inode.edge1.prevInAEL === inode.edge2;
  }
  adjustCurrXAndCopyToSEL(topY) {
    let ae = this.actives;
    for (this.sel = ae; ae !== null; )
      ae.prevInSEL = ae.prevInAEL, ae.nextInSEL = ae.nextInAEL, ae.jump = ae.nextInSEL, ae.curX = _ClipperBase.topX(ae, topY), ae = ae.nextInAEL;
  }
  doMaxima(ae) {
    let prevE = ae.prevInAEL, nextE = ae.nextInAEL;
    if (_ClipperBase.isOpenEnd(ae))
      return _ClipperBase.isHotEdge(ae) && this.addOutPt(ae, ae.top), _ClipperBase.isHorizontal(ae) || (_ClipperBase.isHotEdge(ae) && (_ClipperBase.isFront(ae) ? ae.outrec.frontEdge = null : ae.outrec.backEdge = null, ae.outrec = null), this.deleteFromAEL(ae)), nextE;
    let maxPair = _ClipperBase.getMaximaPair(ae);
    if (maxPair === null)
      return nextE;
    for (this.isJoined(ae) && this.split(ae, ae.top), this.isJoined(maxPair) && this.split(maxPair, maxPair.top); nextE !== maxPair; )
      this.intersectEdges(ae, nextE, ae.top), this.swapPositionsInAEL(ae, nextE), nextE = ae.nextInAEL;
    return _ClipperBase.isOpen(ae) ? (_ClipperBase.isHotEdge(ae) && this.addLocalMaxPoly(ae, maxPair, ae.top), this.deleteFromAEL(maxPair), this.deleteFromAEL(ae), prevE !== null ? prevE.nextInAEL : this.actives) : (_ClipperBase.isHotEdge(ae) && this.addLocalMaxPoly(ae, maxPair, ae.top), this.deleteFromAEL(ae), this.deleteFromAEL(maxPair), prevE !== null ? prevE.nextInAEL : this.actives);
  }
  updateEdgeIntoAEL(ae) {
    if (ae.bot = { x: ae.top.x, y: ae.top.y, z: ae.top.z || 0 }, ae.vertexTop = _ClipperBase.nextVertex(ae), ae.top = { x: ae.vertexTop.pt.x, y: ae.vertexTop.pt.y, z: ae.vertexTop.pt.z || 0 }, ae.curX = ae.bot.x, _ClipperBase.setDx(ae), this.isJoined(ae) && this.split(ae, ae.bot), _ClipperBase.isHorizontal(ae)) {
      _ClipperBase.isOpen(ae) || this.trimHorz(ae, this.preserveCollinear);
      return;
    }
    this.insertScanline(ae.top.y), this.checkJoinLeft(ae, ae.bot), this.checkJoinRight(ae, ae.bot, !0);
  }
  trimHorz(horzEdge, preserveCollinear) {
    let wasTrimmed = !1, pt = _ClipperBase.nextVertex(horzEdge).pt;
    for (; pt.y === horzEdge.top.y && !(preserveCollinear && pt.x < horzEdge.top.x != horzEdge.bot.x < horzEdge.top.x || (horzEdge.vertexTop = _ClipperBase.nextVertex(horzEdge), horzEdge.top = pt, wasTrimmed = !0, _ClipperBase.isMaxima(horzEdge))); )
      pt = _ClipperBase.nextVertex(horzEdge).pt;
    wasTrimmed && _ClipperBase.setDx(horzEdge);
  }
  addToHorzSegList(op) {
    op.outrec.isOpen || this.horzSegList.push(new HorzSegment(op));
  }
  addNewIntersectNode(ae1, ae2, topY) {
    let intersectResult = InternalClipper.getLineIntersectPt(ae1.bot, ae1.top, ae2.bot, ae2.top), ip;
    if (intersectResult.intersects ? ip = intersectResult.point : ip = { x: ae1.curX, y: topY, z: 0 }, ip.y > this.currentBotY || ip.y < topY) {
      let absDx1 = Math.abs(ae1.dx), absDx2 = Math.abs(ae2.dx);
      absDx1 > 100 && absDx2 > 100 ? absDx1 > absDx2 ? ip = InternalClipper.getClosestPtOnSegment(ip, ae1.bot, ae1.top) : ip = InternalClipper.getClosestPtOnSegment(ip, ae2.bot, ae2.top) : absDx1 > 100 ? ip = InternalClipper.getClosestPtOnSegment(ip, ae1.bot, ae1.top) : absDx2 > 100 ? ip = InternalClipper.getClosestPtOnSegment(ip, ae2.bot, ae2.top) : (ip.y < topY ? ip.y = topY : ip.y = this.currentBotY, absDx1 < absDx2 ? ip.x = _ClipperBase.topX(ae1, ip.y) : ip.x = _ClipperBase.topX(ae2, ip.y));
    }
    let node = createIntersectNode(ip, ae1, ae2);
    this.intersectList.push(node);
  }
  extractFromSEL(ae) {
    let res = ae.nextInSEL;
    return res !== null && (res.prevInSEL = ae.prevInSEL), ae.prevInSEL.nextInSEL = res, res;
  }
  insert1Before2InSEL(ae1, ae2) {
    ae1.prevInSEL = ae2.prevInSEL, ae1.prevInSEL !== null && (ae1.prevInSEL.nextInSEL = ae1), ae1.nextInSEL = ae2, ae2.prevInSEL = ae1;
  }
  getCurrYMaximaVertexOpen(ae) {
    let result = ae.vertexTop;
    if (ae.windDx > 0)
      for (; result.next.pt.y === result.pt.y && (result.flags & (VertexFlags.OpenEnd | VertexFlags.LocalMax)) === VertexFlags.None; )
        result = result.next;
    else
      for (; result.prev.pt.y === result.pt.y && (result.flags & (VertexFlags.OpenEnd | VertexFlags.LocalMax)) === VertexFlags.None; )
        result = result.prev;
    return _ClipperBase.isMaxima(result) || (result = null), result;
  }
  getCurrYMaximaVertex(ae) {
    let result = ae.vertexTop;
    if (ae.windDx > 0)
      for (; result.next.pt.y === result.pt.y; )
        result = result.next;
    else
      for (; result.prev.pt.y === result.pt.y; )
        result = result.prev;
    return _ClipperBase.isMaxima(result) || (result = null), result;
  }
  resetHorzDirection(horz, vertexMax) {
    if (horz.bot.x === horz.top.x) {
      let leftX = horz.curX, rightX = horz.curX, ae = horz.nextInAEL;
      for (; ae !== null && ae.vertexTop !== vertexMax; )
        ae = ae.nextInAEL;
      return { isLeftToRight: ae !== null, leftX, rightX };
    }
    return horz.curX < horz.top.x ? { isLeftToRight: !0, leftX: horz.curX, rightX: horz.top.x } : { isLeftToRight: !1, leftX: horz.top.x, rightX: horz.curX };
  }
  getLastOp(hotEdge) {
    let outrec = hotEdge.outrec;
    return hotEdge === outrec.frontEdge ? outrec.pts : outrec.pts.next;
  }
  insertLeftEdge(ae) {
    if (this.actives === null)
      ae.prevInAEL = null, ae.nextInAEL = null, this.actives = ae;
    else if (!this.isValidAelOrder(this.actives, ae))
      ae.prevInAEL = null, ae.nextInAEL = this.actives, this.actives.prevInAEL = ae, this.actives = ae;
    else {
      let ae2 = this.actives;
      for (; ae2.nextInAEL !== null && this.isValidAelOrder(ae2.nextInAEL, ae); )
        ae2 = ae2.nextInAEL;
      ae2.joinWith === JoinWith.Right && (ae2 = ae2.nextInAEL), ae.nextInAEL = ae2.nextInAEL, ae2.nextInAEL !== null && (ae2.nextInAEL.prevInAEL = ae), ae.prevInAEL = ae2, ae2.nextInAEL = ae;
    }
  }
  insertRightEdge(ae1, ae2) {
    ae2.nextInAEL = ae1.nextInAEL, ae1.nextInAEL !== null && (ae1.nextInAEL.prevInAEL = ae2), ae2.prevInAEL = ae1, ae1.nextInAEL = ae2;
  }
  setWindCountForOpenPathEdge(ae) {
    let ae2 = this.actives;
    if (this.fillrule === FillRule.EvenOdd) {
      let cnt1 = 0, cnt2 = 0;
      for (; ae2 !== ae; )
        _ClipperBase.getPolyType(ae2) === PathType.Clip ? cnt2++ : _ClipperBase.isOpen(ae2) || cnt1++, ae2 = ae2.nextInAEL;
      ae.windCount = _ClipperBase.isOdd(cnt1) ? 1 : 0, ae.windCount2 = _ClipperBase.isOdd(cnt2) ? 1 : 0;
    } else
      for (; ae2 !== ae; )
        _ClipperBase.getPolyType(ae2) === PathType.Clip ? ae.windCount2 += ae2.windDx : _ClipperBase.isOpen(ae2) || (ae.windCount += ae2.windDx), ae2 = ae2.nextInAEL;
  }
  setWindCountForClosedPathEdge(ae) {
    let ae2 = ae.prevInAEL, pt = _ClipperBase.getPolyType(ae);
    for (; ae2 !== null && (_ClipperBase.getPolyType(ae2) !== pt || _ClipperBase.isOpen(ae2)); )
      ae2 = ae2.prevInAEL;
    if (ae2 === null ? (ae.windCount = ae.windDx, ae2 = this.actives) : this.fillrule === FillRule.EvenOdd ? (ae.windCount = ae.windDx, ae.windCount2 = ae2.windCount2, ae2 = ae2.nextInAEL) : (ae2.windCount * ae2.windDx < 0 ? Math.abs(ae2.windCount) > 1 ? ae2.windDx * ae.windDx < 0 ? ae.windCount = ae2.windCount : ae.windCount = ae2.windCount + ae.windDx : ae.windCount = _ClipperBase.isOpen(ae) ? 1 : ae.windDx : ae2.windDx * ae.windDx < 0 ? ae.windCount = ae2.windCount : ae.windCount = ae2.windCount + ae.windDx, ae.windCount2 = ae2.windCount2, ae2 = ae2.nextInAEL), this.fillrule === FillRule.EvenOdd)
      for (; ae2 !== ae; )
        _ClipperBase.getPolyType(ae2) !== pt && !_ClipperBase.isOpen(ae2) && (ae.windCount2 = ae.windCount2 === 0 ? 1 : 0), ae2 = ae2.nextInAEL;
    else
      for (; ae2 !== ae; )
        _ClipperBase.getPolyType(ae2) !== pt && !_ClipperBase.isOpen(ae2) && (ae.windCount2 += ae2.windDx), ae2 = ae2.nextInAEL;
  }
  isContributingOpen(ae) {
    let isInClip, isInSubj;
    switch (this.fillrule) {
      case FillRule.Positive:
        isInSubj = ae.windCount > 0, isInClip = ae.windCount2 > 0;
        break;
      case FillRule.Negative:
        isInSubj = ae.windCount < 0, isInClip = ae.windCount2 < 0;
        break;
      default:
        isInSubj = ae.windCount !== 0, isInClip = ae.windCount2 !== 0;
        break;
    }
    switch (this.cliptype) {
      case ClipType.Intersection:
        return isInClip;
      case ClipType.Union:
        return !isInSubj && !isInClip;
      default:
        return !isInClip;
    }
  }
  isContributingClosed(ae) {
    switch (this.fillrule) {
      case FillRule.Positive:
        if (ae.windCount !== 1)
          return !1;
        break;
      case FillRule.Negative:
        if (ae.windCount !== -1)
          return !1;
        break;
      case FillRule.NonZero:
        if (Math.abs(ae.windCount) !== 1)
          return !1;
        break;
    }
    switch (this.cliptype) {
      case ClipType.Intersection:
        return this.fillrule === FillRule.Positive ? ae.windCount2 > 0 : this.fillrule === FillRule.Negative ? ae.windCount2 < 0 : ae.windCount2 !== 0;
      case ClipType.Union:
        return this.fillrule === FillRule.Positive ? ae.windCount2 <= 0 : this.fillrule === FillRule.Negative ? ae.windCount2 >= 0 : ae.windCount2 === 0;
      case ClipType.Difference:
        let result = this.fillrule === FillRule.Positive ? ae.windCount2 <= 0 : this.fillrule === FillRule.Negative ? ae.windCount2 >= 0 : ae.windCount2 === 0;
        return _ClipperBase.getPolyType(ae) === PathType.Subject ? result : !result;
      case ClipType.Xor:
        return !0;
      // XOr is always contributing unless open
      default:
        return !1;
    }
  }
  addLocalMinPoly(ae1, ae2, pt, isNew = !1) {
    let outrec = this.newOutRec();
    if (ae1.outrec = outrec, ae2.outrec = outrec, _ClipperBase.isOpen(ae1))
      outrec.owner = null, outrec.isOpen = !0, ae1.windDx > 0 ? this.setSides(outrec, ae1, ae2) : this.setSides(outrec, ae2, ae1);
    else {
      outrec.isOpen = !1;
      let prevHotEdge = _ClipperBase.getPrevHotEdge(ae1);
      prevHotEdge !== null ? (this.usingPolytree && this.setOwner(outrec, prevHotEdge.outrec), outrec.owner = prevHotEdge.outrec, this.outrecIsAscending(prevHotEdge) === isNew ? this.setSides(outrec, ae2, ae1) : this.setSides(outrec, ae1, ae2)) : (outrec.owner = null, isNew ? this.setSides(outrec, ae1, ae2) : this.setSides(outrec, ae2, ae1));
    }
    let op = new OutPt(pt, outrec);
    return outrec.pts = op, op;
  }
  outrecIsAscending(hotEdge) {
    return hotEdge === hotEdge.outrec.frontEdge;
  }
  newOutRec() {
    let result = new OutRec();
    return result.idx = this.outrecList.length, this.outrecList.push(result), result;
  }
  startOpenPath(ae, pt) {
    let outrec = this.newOutRec();
    outrec.isOpen = !0, ae.windDx > 0 ? (outrec.frontEdge = ae, outrec.backEdge = null) : (outrec.frontEdge = null, outrec.backEdge = ae), ae.outrec = outrec;
    let op = new OutPt(pt, outrec);
    return outrec.pts = op, op;
  }
  checkJoinLeft(ae, pt, checkCurrX = !1) {
    let prev = ae.prevInAEL;
    if (!(prev === null || !_ClipperBase.isHotEdge(ae) || !_ClipperBase.isHotEdge(prev) || _ClipperBase.isHorizontal(ae) || _ClipperBase.isHorizontal(prev) || _ClipperBase.isOpen(ae) || _ClipperBase.isOpen(prev)) && !((pt.y < ae.top.y + 2 || pt.y < prev.top.y + 2) && // avoid trivial joins
    (ae.bot.y > pt.y || prev.bot.y > pt.y))) {
      if (checkCurrX) {
        if (this.perpendicDistFromLineSqrd(pt, prev.bot, prev.top) > 0.25)
          return;
      } else if (ae.curX !== prev.curX)
        return;
      InternalClipper.isCollinear(ae.top, pt, prev.top) && (ae.outrec.idx === prev.outrec.idx ? this.addLocalMaxPoly(prev, ae, pt) : ae.outrec.idx < prev.outrec.idx ? this.joinOutrecPaths(ae, prev) : this.joinOutrecPaths(prev, ae), prev.joinWith = JoinWith.Right, ae.joinWith = JoinWith.Left);
    }
  }
  checkJoinRight(ae, pt, checkCurrX = !1) {
    let next = ae.nextInAEL;
    if (!(next === null || !_ClipperBase.isHotEdge(ae) || !_ClipperBase.isHotEdge(next) || _ClipperBase.isHorizontal(ae) || _ClipperBase.isHorizontal(next) || _ClipperBase.isOpen(ae) || _ClipperBase.isOpen(next)) && !((pt.y < ae.top.y + 2 || pt.y < next.top.y + 2) && // avoid trivial joins
    (ae.bot.y > pt.y || next.bot.y > pt.y))) {
      if (checkCurrX) {
        if (this.perpendicDistFromLineSqrd(pt, next.bot, next.top) > 0.25)
          return;
      } else if (ae.curX !== next.curX)
        return;
      InternalClipper.isCollinear(ae.top, pt, next.top) && (ae.outrec.idx === next.outrec.idx ? this.addLocalMaxPoly(ae, next, pt) : ae.outrec.idx < next.outrec.idx ? this.joinOutrecPaths(ae, next) : this.joinOutrecPaths(next, ae), ae.joinWith = JoinWith.Right, next.joinWith = JoinWith.Left);
    }
  }
  perpendicDistFromLineSqrd(pt, line1, line2) {
    let a = pt.x - line1.x, b = pt.y - line1.y, c = line2.x - line1.x, d = line2.y - line1.y;
    return c === 0 && d === 0 ? 0 : (a * d - c * b) * (a * d - c * b) / (c * c + d * d);
  }
  intersectEdges(ae1, ae2, pt) {
    let resultOp = null;
    if (this.hasOpenPaths && (_ClipperBase.isOpen(ae1) || _ClipperBase.isOpen(ae2))) {
      if (_ClipperBase.isOpen(ae1) && _ClipperBase.isOpen(ae2))
        return;
      if (_ClipperBase.isOpen(ae2) && ([ae1, ae2] = _ClipperBase.swapActives(ae1, ae2)), this.isJoined(ae2) && this.split(ae2, pt), this.cliptype === ClipType.Union) {
        if (!_ClipperBase.isHotEdge(ae2))
          return;
      } else if (ae2.localMin.polytype === PathType.Subject)
        return;
      switch (this.fillrule) {
        case FillRule.Positive:
          if (ae2.windCount !== 1)
            return;
          break;
        case FillRule.Negative:
          if (ae2.windCount !== -1)
            return;
          break;
        default:
          if (Math.abs(ae2.windCount) !== 1)
            return;
          break;
      }
      if (_ClipperBase.isHotEdge(ae1))
        resultOp = this.addOutPt(ae1, pt), this.setZ(ae1, ae2, resultOp.pt), _ClipperBase.isFront(ae1) ? ae1.outrec.frontEdge = null : ae1.outrec.backEdge = null, ae1.outrec = null;
      else if (pt.x === ae1.localMin.vertex.pt.x && pt.y === ae1.localMin.vertex.pt.y && !_ClipperBase.isOpenEndVertex(ae1.localMin.vertex)) {
        let ae3 = this.findEdgeWithMatchingLocMin(ae1);
        if (ae3 !== null && _ClipperBase.isHotEdge(ae3)) {
          ae1.outrec = ae3.outrec, ae1.windDx > 0 ? this.setSides(ae3.outrec, ae1, ae3) : this.setSides(ae3.outrec, ae3, ae1);
          return;
        }
        resultOp = this.startOpenPath(ae1, pt);
      } else
        resultOp = this.startOpenPath(ae1, pt);
      this.setZ(ae1, ae2, resultOp.pt);
      return;
    }
    this.isJoined(ae1) && this.split(ae1, pt), this.isJoined(ae2) && this.split(ae2, pt);
    let oldE1WindCount, oldE2WindCount;
    switch (ae1.localMin.polytype === ae2.localMin.polytype ? this.fillrule === FillRule.EvenOdd ? (oldE1WindCount = ae1.windCount, ae1.windCount = ae2.windCount, ae2.windCount = oldE1WindCount) : (ae1.windCount + ae2.windDx === 0 ? ae1.windCount = -ae1.windCount : ae1.windCount += ae2.windDx, ae2.windCount - ae1.windDx === 0 ? ae2.windCount = -ae2.windCount : ae2.windCount -= ae1.windDx) : (this.fillrule !== FillRule.EvenOdd ? ae1.windCount2 += ae2.windDx : ae1.windCount2 = ae1.windCount2 === 0 ? 1 : 0, this.fillrule !== FillRule.EvenOdd ? ae2.windCount2 -= ae1.windDx : ae2.windCount2 = ae2.windCount2 === 0 ? 1 : 0), this.fillrule) {
      case FillRule.Positive:
        oldE1WindCount = ae1.windCount, oldE2WindCount = ae2.windCount;
        break;
      case FillRule.Negative:
        oldE1WindCount = -ae1.windCount, oldE2WindCount = -ae2.windCount;
        break;
      default:
        oldE1WindCount = Math.abs(ae1.windCount), oldE2WindCount = Math.abs(ae2.windCount);
        break;
    }
    let e1WindCountIs0or1 = oldE1WindCount === 0 || oldE1WindCount === 1, e2WindCountIs0or1 = oldE2WindCount === 0 || oldE2WindCount === 1;
    if (!(!_ClipperBase.isHotEdge(ae1) && !e1WindCountIs0or1 || !_ClipperBase.isHotEdge(ae2) && !e2WindCountIs0or1))
      if (_ClipperBase.isHotEdge(ae1) && _ClipperBase.isHotEdge(ae2))
        if (oldE1WindCount !== 0 && oldE1WindCount !== 1 || oldE2WindCount !== 0 && oldE2WindCount !== 1 || ae1.localMin.polytype !== ae2.localMin.polytype && this.cliptype !== ClipType.Xor)
          resultOp = this.addLocalMaxPoly(ae1, ae2, pt), resultOp && this.setZ(ae1, ae2, resultOp.pt);
        else if (_ClipperBase.isFront(ae1) || ae1.outrec === ae2.outrec) {
          resultOp = this.addLocalMaxPoly(ae1, ae2, pt), resultOp && this.setZ(ae1, ae2, resultOp.pt);
          let op2 = this.addLocalMinPoly(ae1, ae2, pt);
          this.setZ(ae1, ae2, op2.pt);
        } else {
          resultOp = this.addOutPt(ae1, pt), this.setZ(ae1, ae2, resultOp.pt);
          let op2 = this.addOutPt(ae2, pt);
          this.setZ(ae1, ae2, op2.pt), this.swapOutrecs(ae1, ae2);
        }
      else if (_ClipperBase.isHotEdge(ae1))
        resultOp = this.addOutPt(ae1, pt), this.setZ(ae1, ae2, resultOp.pt), this.swapOutrecs(ae1, ae2);
      else if (_ClipperBase.isHotEdge(ae2))
        resultOp = this.addOutPt(ae2, pt), this.setZ(ae1, ae2, resultOp.pt), this.swapOutrecs(ae1, ae2);
      else {
        let e1Wc2, e2Wc2;
        switch (this.fillrule) {
          case FillRule.Positive:
            e1Wc2 = ae1.windCount2, e2Wc2 = ae2.windCount2;
            break;
          case FillRule.Negative:
            e1Wc2 = -ae1.windCount2, e2Wc2 = -ae2.windCount2;
            break;
          default:
            e1Wc2 = Math.abs(ae1.windCount2), e2Wc2 = Math.abs(ae2.windCount2);
            break;
        }
        if (!_ClipperBase.isSamePolyType(ae1, ae2))
          resultOp = this.addLocalMinPoly(ae1, ae2, pt), this.setZ(ae1, ae2, resultOp.pt);
        else if (oldE1WindCount === 1 && oldE2WindCount === 1) {
          switch (resultOp = null, this.cliptype) {
            case ClipType.Union:
              if (e1Wc2 > 0 && e2Wc2 > 0)
                return;
              resultOp = this.addLocalMinPoly(ae1, ae2, pt);
              break;
            case ClipType.Difference:
              (_ClipperBase.getPolyType(ae1) === PathType.Clip && e1Wc2 > 0 && e2Wc2 > 0 || _ClipperBase.getPolyType(ae1) === PathType.Subject && e1Wc2 <= 0 && e2Wc2 <= 0) && (resultOp = this.addLocalMinPoly(ae1, ae2, pt));
              break;
            case ClipType.Xor:
              resultOp = this.addLocalMinPoly(ae1, ae2, pt);
              break;
            default:
              if (e1Wc2 <= 0 || e2Wc2 <= 0)
                return;
              resultOp = this.addLocalMinPoly(ae1, ae2, pt);
              break;
          }
          resultOp && this.setZ(ae1, ae2, resultOp.pt);
        }
      }
  }
  swapPositionsInAEL(ae1, ae2) {
    let next = ae2.nextInAEL;
    next !== null && (next.prevInAEL = ae1);
    let prev = ae1.prevInAEL;
    prev !== null && (prev.nextInAEL = ae2), ae2.prevInAEL = prev, ae2.nextInAEL = ae1, ae1.prevInAEL = ae2, ae1.nextInAEL = next, ae2.prevInAEL === null && (this.actives = ae2);
  }
  isValidAelOrder(resident, newcomer) {
    if (newcomer.curX !== resident.curX)
      return newcomer.curX > resident.curX;
    let d = InternalClipper.crossProduct(resident.top, newcomer.bot, newcomer.top);
    if (d !== 0)
      return d < 0;
    if (!_ClipperBase.isMaxima(resident) && resident.top.y > newcomer.top.y)
      return InternalClipper.crossProduct(newcomer.bot, resident.top, _ClipperBase.nextVertex(resident).pt) <= 0;
    if (!_ClipperBase.isMaxima(newcomer) && newcomer.top.y > resident.top.y)
      return InternalClipper.crossProduct(newcomer.bot, newcomer.top, _ClipperBase.nextVertex(newcomer).pt) >= 0;
    let y = newcomer.bot.y, newcomerIsLeft = newcomer.isLeftBound;
    return resident.bot.y !== y || resident.localMin.vertex.pt.y !== y ? newcomer.isLeftBound : resident.isLeftBound !== newcomerIsLeft ? newcomerIsLeft : InternalClipper.isCollinear(_ClipperBase.prevPrevVertex(resident).pt, resident.bot, resident.top) ? !0 : InternalClipper.crossProduct(_ClipperBase.prevPrevVertex(resident).pt, newcomer.bot, _ClipperBase.prevPrevVertex(newcomer).pt) > 0 === newcomerIsLeft;
  }
  isJoined(e) {
    return e.joinWith !== JoinWith.None;
  }
  split(e, currPt) {
    e.joinWith === JoinWith.Right ? (e.joinWith = JoinWith.None, e.nextInAEL.joinWith = JoinWith.None, this.addLocalMinPoly(e, e.nextInAEL, currPt, !0)) : (e.joinWith = JoinWith.None, e.prevInAEL.joinWith = JoinWith.None, this.addLocalMinPoly(e.prevInAEL, e, currPt, !0));
  }
  setSides(outrec, startEdge, endEdge) {
    outrec.frontEdge = startEdge, outrec.backEdge = endEdge;
  }
  findEdgeWithMatchingLocMin(e) {
    let result = e.nextInAEL;
    for (; result !== null; ) {
      if (result.localMin?.equals(e.localMin))
        return result;
      !_ClipperBase.isHorizontal(result) && !(e.bot.x === result.bot.x && e.bot.y === result.bot.y) ? result = null : result = result.nextInAEL;
    }
    for (result = e.prevInAEL; result !== null; ) {
      if (result.localMin?.equals(e.localMin))
        return result;
      if (!_ClipperBase.isHorizontal(result) && !(e.bot.x === result.bot.x && e.bot.y === result.bot.y))
        return null;
      result = result.prevInAEL;
    }
    return result;
  }
  addOutPt(ae, pt) {
    let outrec = ae.outrec, toFront = _ClipperBase.isFront(ae), opFront = outrec.pts, opBack = opFront.next;
    if (toFront && pt.x === opFront.pt.x && pt.y === opFront.pt.y)
      return opFront;
    if (!toFront && pt.x === opBack.pt.x && pt.y === opBack.pt.y)
      return opBack;
    let newOp = new OutPt(pt, outrec);
    return opBack.prev = newOp, newOp.prev = opFront, newOp.next = opBack, opFront.next = newOp, toFront && (outrec.pts = newOp), newOp;
  }
  addLocalMaxPoly(ae1, ae2, pt) {
    if (this.isJoined(ae1) && this.split(ae1, pt), this.isJoined(ae2) && this.split(ae2, pt), _ClipperBase.isFront(ae1) === _ClipperBase.isFront(ae2))
      if (_ClipperBase.isOpenEnd(ae1))
        this.swapFrontBackSides(ae1.outrec);
      else if (_ClipperBase.isOpenEnd(ae2))
        this.swapFrontBackSides(ae2.outrec);
      else
        return this.succeeded = !1, null;
    let result = this.addOutPt(ae1, pt);
    if (ae1.outrec === ae2.outrec) {
      let outrec = ae1.outrec;
      if (outrec.pts = result, this.usingPolytree) {
        let e = _ClipperBase.getPrevHotEdge(ae1);
        e === null ? outrec.owner = null : this.setOwner(outrec, e.outrec);
      }
      this.uncoupleOutRec(ae1);
    } else _ClipperBase.isOpen(ae1) ? ae1.windDx < 0 ? this.joinOutrecPaths(ae1, ae2) : this.joinOutrecPaths(ae2, ae1) : ae1.outrec.idx < ae2.outrec.idx ? this.joinOutrecPaths(ae1, ae2) : this.joinOutrecPaths(ae2, ae1);
    return result;
  }
  swapFrontBackSides(outrec) {
    let ae2 = outrec.frontEdge;
    outrec.frontEdge = outrec.backEdge, outrec.backEdge = ae2, outrec.pts = outrec.pts.next;
  }
  setOwner(outrec, newOwner) {
    for (; newOwner.owner !== null && newOwner.owner.pts === null; )
      newOwner.owner = newOwner.owner.owner;
    let tmp = newOwner;
    for (; tmp !== null && tmp !== outrec; )
      tmp = tmp.owner;
    tmp !== null && (newOwner.owner = outrec.owner), outrec.owner = newOwner;
  }
  uncoupleOutRec(ae) {
    let outrec = ae.outrec;
    outrec !== null && (outrec.frontEdge.outrec = null, outrec.backEdge.outrec = null, outrec.frontEdge = null, outrec.backEdge = null);
  }
  joinOutrecPaths(ae1, ae2) {
    let p1Start = ae1.outrec.pts, p2Start = ae2.outrec.pts, p1End = p1Start.next, p2End = p2Start.next;
    _ClipperBase.isFront(ae1) ? (p2End.prev = p1Start, p1Start.next = p2End, p2Start.next = p1End, p1End.prev = p2Start, ae1.outrec.pts = p2Start, ae1.outrec.frontEdge = ae2.outrec.frontEdge, ae1.outrec.frontEdge !== null && (ae1.outrec.frontEdge.outrec = ae1.outrec)) : (p1End.prev = p2Start, p2Start.next = p1End, p1Start.next = p2End, p2End.prev = p1Start, ae1.outrec.backEdge = ae2.outrec.backEdge, ae1.outrec.backEdge !== null && (ae1.outrec.backEdge.outrec = ae1.outrec)), ae2.outrec.frontEdge = null, ae2.outrec.backEdge = null, ae2.outrec.pts = null, this.setOwner(ae2.outrec, ae1.outrec), _ClipperBase.isOpenEnd(ae1) && (ae2.outrec.pts = ae1.outrec.pts, ae1.outrec.pts = null), ae1.outrec = null, ae2.outrec = null;
  }
  swapOutrecs(ae1, ae2) {
    let or1 = ae1.outrec, or2 = ae2.outrec;
    if (or1 === or2) {
      let ae = or1.frontEdge;
      or1.frontEdge = or1.backEdge, or1.backEdge = ae;
      return;
    }
    or1 !== null && (ae1 === or1.frontEdge ? or1.frontEdge = ae2 : or1.backEdge = ae2), or2 !== null && (ae2 === or2.frontEdge ? or2.frontEdge = ae1 : or2.backEdge = ae1), ae1.outrec = or2, ae2.outrec = or1;
  }
  disposeIntersectNodes() {
    this.intersectList.length = 0;
  }
  static ptsReallyClose(pt1, pt2) {
    return Math.abs(pt1.x - pt2.x) < 2 && Math.abs(pt1.y - pt2.y) < 2;
  }
  static isVerySmallTriangle(op) {
    return op.next.next === op.prev && (_ClipperBase.ptsReallyClose(op.prev.pt, op.next.pt) || _ClipperBase.ptsReallyClose(op.pt, op.next.pt) || _ClipperBase.ptsReallyClose(op.pt, op.prev.pt));
  }
  static buildPath(op, reverse, isOpen, path) {
    if (op === null || op.next === op || !isOpen && op.next === op.prev)
      return !1;
    path.length = 0;
    let lastPt, op2;
    for (reverse ? (lastPt = op.pt, op2 = op.prev) : (op = op.next, lastPt = op.pt, op2 = op.next), path.push(lastPt); op2 !== op; )
      op2.pt.x === lastPt.x && op2.pt.y === lastPt.y || (lastPt = op2.pt, path.push(lastPt)), reverse ? op2 = op2.prev : op2 = op2.next;
    return path.length !== 3 || isOpen || !_ClipperBase.isVerySmallTriangle(op2);
  }
  buildPaths(solutionClosed, solutionOpen) {
    solutionClosed.length = 0, solutionOpen.length = 0;
    let i = 0;
    for (; i < this.outrecList.length; ) {
      let outrec = this.outrecList[i++];
      if (outrec.pts === null)
        continue;
      let path = [];
      outrec.isOpen ? _ClipperBase.buildPath(outrec.pts, this.reverseSolution, !0, path) && solutionOpen.push(path) : (this.cleanCollinear(outrec), _ClipperBase.buildPath(outrec.pts, this.reverseSolution, !1, path) && solutionClosed.push(path));
    }
    return !0;
  }
  buildTree(polytree, solutionOpen) {
    polytree.clear(), solutionOpen.length = 0;
    let i = 0;
    for (; i < this.outrecList.length; ) {
      let outrec = this.outrecList[i++];
      if (outrec.pts !== null) {
        if (outrec.isOpen) {
          let openPath = [];
          _ClipperBase.buildPath(outrec.pts, this.reverseSolution, !0, openPath) && solutionOpen.push(openPath);
          continue;
        }
        this.checkBounds(outrec) && this.recursiveCheckOwners(outrec, polytree);
      }
    }
  }
  checkBounds(outrec) {
    return outrec.pts === null ? !1 : Rect64Utils.isEmpty(outrec.bounds) ? (this.cleanCollinear(outrec), outrec.pts === null || !_ClipperBase.buildPath(outrec.pts, this.reverseSolution, !1, outrec.path) ? !1 : (outrec.bounds = InternalClipper.getBounds(outrec.path), !0)) : !0;
  }
  recursiveCheckOwners(outrec, polypath) {
    if (!(outrec.polypath !== null || Rect64Utils.isEmpty(outrec.bounds))) {
      for (; outrec.owner !== null && !(outrec.owner.splits !== null && this.checkSplitOwner(outrec, outrec.owner.splits) || outrec.owner.pts !== null && this.checkBounds(outrec.owner) && // Fast reject: a container must contain the child's bounds.
      this.containsRect(outrec.owner.bounds, outrec.bounds) && this.path1InsidePath2(outrec.pts, outrec.owner.pts)); )
        outrec.owner = outrec.owner.owner;
      outrec.owner !== null ? (outrec.owner.polypath === null && this.recursiveCheckOwners(outrec.owner, polypath), outrec.polypath = outrec.owner.polypath.addChild(outrec.path)) : outrec.polypath = polypath.addChild(outrec.path);
    }
  }
  cleanCollinear(outrec) {
    if (outrec = this.getRealOutRec(outrec), outrec === null || outrec.isOpen)
      return;
    if (!this.isValidClosedPath(outrec.pts)) {
      outrec.pts = null;
      return;
    }
    let startOp = outrec.pts, op2 = startOp;
    for (; ; ) {
      if (op2 !== null && InternalClipper.isCollinear(op2.prev.pt, op2.pt, op2.next.pt) && (op2.pt.x === op2.prev.pt.x && op2.pt.y === op2.prev.pt.y || op2.pt.x === op2.next.pt.x && op2.pt.y === op2.next.pt.y || !this.preserveCollinear || InternalClipper.dotProduct(op2.prev.pt, op2.pt, op2.next.pt) < 0)) {
        if (op2 === outrec.pts && (outrec.pts = op2.prev), op2 = this.disposeOutPt(op2), !this.isValidClosedPath(op2)) {
          outrec.pts = null;
          return;
        }
        startOp = op2;
        continue;
      }
      if (op2 === null || (op2 = op2.next, op2 === startOp))
        break;
    }
    this.fixSelfIntersects(outrec);
  }
  isValidClosedPath(op) {
    return op !== null && op.next !== op && (op.next !== op.prev || !_ClipperBase.isVerySmallTriangle(op));
  }
  disposeOutPt(op) {
    let result = op.next === op ? null : op.next;
    return op.prev.next = op.next, op.next.prev = op.prev, result;
  }
  fixSelfIntersects(outrec) {
    let op2 = outrec.pts;
    if (op2.prev !== op2.next.next)
      for (; ; ) {
        if (op2.next && op2.next.next && // optimization (not in C# reference): bbox check before segsIntersect  
        this.boundingBoxesOverlap(op2.prev.pt, op2.pt, op2.next.pt, op2.next.next.pt) && // TEST: Bbox only
        InternalClipper.segsIntersect(op2.prev.pt, op2.pt, op2.next.pt, op2.next.next.pt))
          if (op2.next.next.next && // optimization (not in C# reference): bbox check before segsIntersect
          this.boundingBoxesOverlap(op2.prev.pt, op2.pt, op2.next.next.pt, op2.next.next.next.pt) && // TEST: Bbox only
          InternalClipper.segsIntersect(op2.prev.pt, op2.pt, op2.next.next.pt, op2.next.next.next.pt))
            op2 = this.duplicateOp(op2, !1), op2.pt = op2.next.next.next.pt, op2 = op2.next;
          else {
            if ((op2 === outrec.pts || op2.next === outrec.pts) && (outrec.pts = outrec.pts.prev), this.doSplitOp(outrec, op2), outrec.pts === null)
              return;
            if (op2 = outrec.pts, op2.prev === op2.next.next)
              break;
            continue;
          }
        if (op2 = op2.next, op2 === outrec.pts)
          break;
      }
  }
  doSplitOp(outrec, splitOp) {
    let prevOp = splitOp.prev, nextNextOp = splitOp.next.next;
    outrec.pts = prevOp;
    let ip = InternalClipper.getLineIntersectPt(prevOp.pt, splitOp.pt, splitOp.next.pt, nextNextOp.pt).point, area1 = _ClipperBase.areaOutPt(prevOp), absArea1 = Math.abs(area1);
    if (absArea1 < 2) {
      outrec.pts = null;
      return;
    }
    let area2 = this.areaTriangle(ip, splitOp.pt, splitOp.next.pt), absArea2 = Math.abs(area2);
    if (ip.x === prevOp.pt.x && ip.y === prevOp.pt.y || ip.x === nextNextOp.pt.x && ip.y === nextNextOp.pt.y)
      nextNextOp.prev = prevOp, prevOp.next = nextNextOp;
    else {
      let newOp2 = new OutPt(ip, outrec);
      newOp2.prev = prevOp, newOp2.next = nextNextOp, nextNextOp.prev = newOp2, prevOp.next = newOp2;
    }
    if (!(absArea2 > 1) || !(absArea2 > absArea1) && area2 > 0 != area1 > 0)
      return;
    let newOutRec = this.newOutRec();
    newOutRec.owner = outrec.owner, splitOp.outrec = newOutRec, splitOp.next.outrec = newOutRec;
    let newOp = new OutPt(ip, newOutRec);
    newOp.prev = splitOp.next, newOp.next = splitOp, newOutRec.pts = newOp, splitOp.prev = newOp, splitOp.next.next = newOp, this.usingPolytree && (this.path1InsidePath2(prevOp, newOp) ? (newOutRec.splits === null && (newOutRec.splits = []), newOutRec.splits.push(outrec.idx)) : (outrec.splits === null && (outrec.splits = []), outrec.splits.push(newOutRec.idx)));
  }
  static areaOutPt(op) {
    let area = 0, op2 = op;
    do
      area += (op2.prev.pt.y + op2.pt.y) * (op2.prev.pt.x - op2.pt.x), op2 = op2.next;
    while (op2 !== op);
    return area * 0.5;
  }
  areaTriangle(pt1, pt2, pt3) {
    return (pt3.y + pt1.y) * (pt3.x - pt1.x) + (pt1.y + pt2.y) * (pt1.x - pt2.x) + (pt2.y + pt3.y) * (pt2.x - pt3.x);
  }
  isValidOwner(outRec, testOwner) {
    for (; testOwner !== null && testOwner !== outRec; )
      testOwner = testOwner.owner;
    return testOwner === null;
  }
  containsRect(rect, rec) {
    return rec.left >= rect.left && rec.right <= rect.right && rec.top >= rect.top && rec.bottom <= rect.bottom;
  }
  checkSplitOwner(outrec, splits) {
    for (let i = 0; i < splits.length; i++) {
      let split = this.outrecList[splits[i]];
      if (split.pts === null && split.splits !== null && this.checkSplitOwner(outrec, split.splits))
        return !0;
      if (split = this.getRealOutRec(split), !(split === null || split === outrec || split.recursiveSplit === outrec)) {
        if (split.recursiveSplit = outrec, split.splits !== null && this.checkSplitOwner(outrec, split.splits))
          return !0;
        if (!(!this.checkBounds(split) || !this.containsRect(split.bounds, outrec.bounds) || !this.path1InsidePath2(outrec.pts, split.pts)))
          return this.isValidOwner(outrec, split) || (split.owner = outrec.owner), outrec.owner = split, !0;
      }
    }
    return !1;
  }
}, Clipper64 = class extends ClipperBase {
  zCallback;
  getZCallback() {
    return this.zCallback;
  }
  addPath(path, polytype, isOpen = !1) {
    super.addPath(path, polytype, isOpen);
  }
  addReuseableData(reuseableData) {
    super.addReuseableData(reuseableData);
  }
  addPaths(paths, polytype, isOpen = !1) {
    super.addPaths(paths, polytype, isOpen);
  }
  addSubject(paths) {
    this.addPaths(paths, PathType.Subject);
  }
  addOpenSubject(paths) {
    this.addPaths(paths, PathType.Subject, !0);
  }
  addClip(paths) {
    this.addPaths(paths, PathType.Clip);
  }
  execute(clipType, fillRule, solutionOrTree, openPathsOrSolutionOpen) {
    if (Array.isArray(solutionOrTree)) {
      let solutionClosed = solutionOrTree, solutionOpen = openPathsOrSolutionOpen;
      solutionClosed.length = 0, solutionOpen && (solutionOpen.length = 0);
      try {
        this.executeInternal(clipType, fillRule), this.buildPaths(solutionClosed, solutionOpen || []);
      } catch {
        this.succeeded = !1;
      }
      return this.clearSolutionOnly(), this.succeeded;
    } else {
      let polytree = solutionOrTree, openPaths = openPathsOrSolutionOpen;
      polytree.clear(), openPaths && (openPaths.length = 0), this.usingPolytree = !0;
      try {
        this.executeInternal(clipType, fillRule), this.buildTree(polytree, openPaths || []);
      } catch {
        this.succeeded = !1;
      }
      return this.clearSolutionOnly(), this.succeeded;
    }
  }
};
var Clipper;
(function(Clipper2) {
  function area(path) {
    let a = 0, cnt = path.length;
    if (cnt < 3)
      return 0;
    let prevPt = path[cnt - 1];
    for (let pt of path)
      a += (prevPt.y + pt.y) * (prevPt.x - pt.x), prevPt = pt;
    return a * 0.5;
  }
  Clipper2.area = area;
  function areaD(path) {
    let a = 0, cnt = path.length;
    if (cnt < 3)
      return 0;
    let prevPt = path[cnt - 1];
    for (let pt of path)
      a += (prevPt.y + pt.y) * (prevPt.x - pt.x), prevPt = pt;
    return a * 0.5;
  }
  Clipper2.areaD = areaD;
  function scalePath64(path, scale) {
    let result = [];
    for (let pt of path)
      result.push({
        x: Math.round(pt.x * scale),
        y: Math.round(pt.y * scale)
      });
    return result;
  }
  Clipper2.scalePath64 = scalePath64;
  function scalePaths64(paths, scale) {
    let result = [];
    for (let path of paths)
      result.push(scalePath64(path, scale));
    return result;
  }
  Clipper2.scalePaths64 = scalePaths64;
  function scalePathD(path, scale) {
    let result = [];
    for (let pt of path)
      result.push({
        x: pt.x * scale,
        y: pt.y * scale
      });
    return result;
  }
  Clipper2.scalePathD = scalePathD;
  function scalePathsD(paths, scale) {
    let result = [];
    for (let path of paths)
      result.push(scalePathD(path, scale));
    return result;
  }
  Clipper2.scalePathsD = scalePathsD;
})(Clipper || (Clipper = {}));

// node_modules/clipper2-ts/dist/Offset.js
var JoinType;
(function(JoinType2) {
  JoinType2[JoinType2.Miter = 0] = "Miter", JoinType2[JoinType2.Square = 1] = "Square", JoinType2[JoinType2.Bevel = 2] = "Bevel", JoinType2[JoinType2.Round = 3] = "Round";
})(JoinType || (JoinType = {}));
var EndType;
(function(EndType2) {
  EndType2[EndType2.Polygon = 0] = "Polygon", EndType2[EndType2.Joined = 1] = "Joined", EndType2[EndType2.Butt = 2] = "Butt", EndType2[EndType2.Square = 3] = "Square", EndType2[EndType2.Round = 4] = "Round";
})(EndType || (EndType = {}));
var Group = class {
  inPaths;
  joinType;
  endType;
  pathsReversed;
  lowestPathIdx;
  constructor(paths, joinType, endType = EndType.Polygon) {
    this.joinType = joinType, this.endType = endType;
    let isJoined = endType === EndType.Polygon || endType === EndType.Joined;
    this.inPaths = [];
    for (let path of paths)
      this.inPaths.push(ClipperOffset.stripDuplicates(path, isJoined));
    if (endType === EndType.Polygon) {
      let lowestInfo = ClipperOffset.getLowestPathInfo(this.inPaths);
      this.lowestPathIdx = lowestInfo.idx, this.pathsReversed = this.lowestPathIdx >= 0 && lowestInfo.isNegArea;
    } else
      this.lowestPathIdx = -1, this.pathsReversed = !1;
  }
}, ClipperOffset = class _ClipperOffset {
  static Tolerance = 1e-12;
  // Clipper2 approximates arcs by using series of relatively short straight
  //line segments. And logically, shorter line segments will produce better arc
  // approximations. But very short segments can degrade performance, usually
  // with little or no discernable improvement in curve quality. Very short
  // segments can even detract from curve quality, due to the effects of integer
  // rounding. Since there isn't an optimal number of line segments for any given
  // arc radius (that perfectly balances curve approximation with performance),
  // arc tolerance is user defined. Nevertheless, when the user doesn't define
  // an arc tolerance (ie leaves alone the 0 default value), the calculated
  // default arc tolerance (offset_radius / 500) generally produces good (smooth)
  // arc approximations without producing excessively small segment lengths.
  // See also: https://www.angusj.com/clipper2/Docs/Trigonometry.htm
  static arc_const = 2e-3;
  // <-- 1/500
  groupList = [];
  pathOut = [];
  normals = [];
  solution = [];
  solutionTree = null;
  groupDelta = 0;
  //*0.5 for open paths; *-1.0 for negative areas
  delta = 0;
  mitLimSqr = 0;
  stepsPerRad = 0;
  stepSin = 0;
  stepCos = 0;
  joinType = JoinType.Bevel;
  endType = EndType.Polygon;
  arcTolerance = 0;
  mergeGroups = !0;
  miterLimit = 2;
  preserveCollinear = !1;
  reverseSolution = !1;
  zCallback;
  deltaCallback = null;
  constructor(miterLimit = 2, arcTolerance = 0, preserveCollinear = !1, reverseSolution = !1) {
    this.miterLimit = miterLimit, this.arcTolerance = arcTolerance, this.mergeGroups = !0, this.preserveCollinear = preserveCollinear, this.reverseSolution = reverseSolution;
  }
  clear() {
    this.groupList.length = 0;
  }
  // Internal Z callback that implements default Z handling before calling user callback
  ZCB = (bot1, top1, bot2, top2, intersectPt) => {
    (bot1.z || 0) !== 0 && (bot1.z === bot2.z || bot1.z === top2.z) ? intersectPt.z = bot1.z : (bot2.z || 0) !== 0 && bot2.z === top1.z ? intersectPt.z = bot2.z : (top1.z || 0) !== 0 && top1.z === top2.z ? intersectPt.z = top1.z : this.zCallback && this.zCallback(bot1, top1, bot2, top2, intersectPt);
  };
  addPath(path, joinType, endType) {
    if (path.length === 0)
      return;
    let pp = [path];
    this.addPaths(pp, joinType, endType);
  }
  addPaths(paths, joinType, endType) {
    paths.length !== 0 && this.groupList.push(new Group(paths, joinType, endType));
  }
  calcSolutionCapacity() {
    let result = 0;
    for (let g of this.groupList)
      result += g.endType === EndType.Joined ? g.inPaths.length * 2 : g.inPaths.length;
    return result;
  }
  checkPathsReversed() {
    let result = !1;
    for (let g of this.groupList)
      if (g.endType === EndType.Polygon) {
        result = g.pathsReversed;
        break;
      }
    return result;
  }
  executeInternal(delta) {
    if (this.groupList.length === 0)
      return;
    if (Math.abs(delta) < 0.5) {
      for (let group of this.groupList)
        for (let path of group.inPaths)
          this.solution.push(path);
      return;
    }
    this.delta = delta, this.mitLimSqr = this.miterLimit <= 1 ? 2 : 2 / _ClipperOffset.sqr(this.miterLimit);
    for (let group of this.groupList)
      this.doGroupOffset(group);
    if (this.groupList.length === 0)
      return;
    let pathsReversed = this.checkPathsReversed(), fillRule = pathsReversed ? FillRule.Negative : FillRule.Positive, c = new Clipper64();
    c.preserveCollinear = this.preserveCollinear, c.reverseSolution = this.reverseSolution !== pathsReversed, c.zCallback = this.ZCB, c.addSubject(this.solution), this.solutionTree !== null ? c.execute(ClipType.Union, fillRule, this.solutionTree) : c.execute(ClipType.Union, fillRule, this.solution);
  }
  execute(delta, solutionOrTree) {
    if (Array.isArray(solutionOrTree)) {
      let solution = solutionOrTree;
      solution.length = 0, this.solution = solution, this.executeInternal(delta);
    } else {
      let solutionTree = solutionOrTree;
      solutionTree.clear(), this.solutionTree = solutionTree, this.solution = [], this.executeInternal(delta);
    }
  }
  executeWithCallback(deltaCallback, solution) {
    this.deltaCallback = deltaCallback, this.execute(1, solution);
  }
  static getUnitNormal(pt1, pt2) {
    let dx = pt2.x - pt1.x, dy = pt2.y - pt1.y;
    if (dx === 0 && dy === 0)
      return { x: 0, y: 0 };
    let f = 1 / Math.sqrt(dx * dx + dy * dy);
    return {
      x: dy * f,
      y: -dx * f
    };
  }
  static getLowestPathInfo(paths) {
    let idx = -1, isNegArea = !1, botPt = { x: Number.MAX_SAFE_INTEGER, y: Number.MIN_SAFE_INTEGER };
    for (let i = 0; i < paths.length; ++i) {
      let a = Number.MAX_VALUE;
      for (let pt of paths[i])
        if (!(pt.y < botPt.y || pt.y === botPt.y && pt.x >= botPt.x)) {
          if (a === Number.MAX_VALUE) {
            if (a = _ClipperOffset.area(paths[i]), a === 0)
              break;
            isNegArea = a < 0;
          }
          idx = i, botPt.x = pt.x, botPt.y = pt.y;
        }
    }
    return { idx, isNegArea };
  }
  static translatePoint(pt, dx, dy) {
    return { x: pt.x + dx, y: pt.y + dy };
  }
  static reflectPoint(pt, pivot) {
    return { x: pivot.x + (pivot.x - pt.x), y: pivot.y + (pivot.y - pt.y) };
  }
  static almostZero(value, epsilon = 1e-3) {
    return Math.abs(value) < epsilon;
  }
  static hypotenuse(x, y) {
    return Math.sqrt(Math.pow(x, 2) + Math.pow(y, 2));
  }
  static normalizeVector(vec) {
    let h = _ClipperOffset.hypotenuse(vec.x, vec.y);
    if (_ClipperOffset.almostZero(h))
      return { x: 0, y: 0 };
    let inverseHypot = 1 / h;
    return { x: vec.x * inverseHypot, y: vec.y * inverseHypot };
  }
  static getAvgUnitVector(vec1, vec2) {
    return _ClipperOffset.normalizeVector({ x: vec1.x + vec2.x, y: vec1.y + vec2.y });
  }
  static intersectPoint(pt1a, pt1b, pt2a, pt2b) {
    if (InternalClipper.isAlmostZero(pt1a.x - pt1b.x)) {
      if (InternalClipper.isAlmostZero(pt2a.x - pt2b.x))
        return { x: 0, y: 0 };
      let m2 = (pt2b.y - pt2a.y) / (pt2b.x - pt2a.x), b2 = pt2a.y - m2 * pt2a.x;
      return { x: pt1a.x, y: m2 * pt1a.x + b2 };
    }
    if (InternalClipper.isAlmostZero(pt2a.x - pt2b.x)) {
      let m1 = (pt1b.y - pt1a.y) / (pt1b.x - pt1a.x), b1 = pt1a.y - m1 * pt1a.x;
      return { x: pt2a.x, y: m1 * pt2a.x + b1 };
    } else {
      let m1 = (pt1b.y - pt1a.y) / (pt1b.x - pt1a.x), b1 = pt1a.y - m1 * pt1a.x, m2 = (pt2b.y - pt2a.y) / (pt2b.x - pt2a.x), b2 = pt2a.y - m2 * pt2a.x;
      if (InternalClipper.isAlmostZero(m1 - m2))
        return { x: 0, y: 0 };
      let x = (b2 - b1) / (m1 - m2);
      return { x, y: m1 * x + b1 };
    }
  }
  getPerpendic(pt, norm) {
    return {
      x: Math.round(pt.x + norm.x * this.groupDelta),
      y: Math.round(pt.y + norm.y * this.groupDelta)
    };
  }
  getPerpendicD(pt, norm) {
    return {
      x: pt.x + norm.x * this.groupDelta,
      y: pt.y + norm.y * this.groupDelta
    };
  }
  doBevel(path, j, k) {
    let pt1, pt2;
    if (j === k) {
      let absDelta = Math.abs(this.groupDelta);
      pt1 = {
        x: Math.round(path[j].x - absDelta * this.normals[j].x),
        y: Math.round(path[j].y - absDelta * this.normals[j].y)
      }, pt2 = {
        x: Math.round(path[j].x + absDelta * this.normals[j].x),
        y: Math.round(path[j].y + absDelta * this.normals[j].y)
      };
    } else
      pt1 = {
        x: Math.round(path[j].x + this.groupDelta * this.normals[k].x),
        y: Math.round(path[j].y + this.groupDelta * this.normals[k].y)
      }, pt2 = {
        x: Math.round(path[j].x + this.groupDelta * this.normals[j].x),
        y: Math.round(path[j].y + this.groupDelta * this.normals[j].y)
      };
    this.pathOut.push(pt1), this.pathOut.push(pt2);
  }
  doSquare(path, j, k) {
    let vec;
    j === k ? vec = { x: this.normals[j].y, y: -this.normals[j].x } : vec = _ClipperOffset.getAvgUnitVector({ x: -this.normals[k].y, y: this.normals[k].x }, { x: this.normals[j].y, y: -this.normals[j].x });
    let absDelta = Math.abs(this.groupDelta), ptQ = { x: path[j].x, y: path[j].y };
    ptQ = _ClipperOffset.translatePoint(ptQ, absDelta * vec.x, absDelta * vec.y);
    let pt1 = _ClipperOffset.translatePoint(ptQ, this.groupDelta * vec.y, this.groupDelta * -vec.x), pt2 = _ClipperOffset.translatePoint(ptQ, this.groupDelta * -vec.y, this.groupDelta * vec.x), pt3 = this.getPerpendicD(path[k], this.normals[k]);
    if (j === k) {
      let pt4 = {
        x: pt3.x + vec.x * this.groupDelta,
        y: pt3.y + vec.y * this.groupDelta
      }, pt = _ClipperOffset.intersectPoint(pt1, pt2, pt3, pt4);
      this.pathOut.push(Point64Utils.fromPointD(_ClipperOffset.reflectPoint(pt, ptQ))), this.pathOut.push(Point64Utils.fromPointD(pt));
    } else {
      let pt4 = this.getPerpendicD(path[j], this.normals[k]), pt = _ClipperOffset.intersectPoint(pt1, pt2, pt3, pt4);
      this.pathOut.push(Point64Utils.fromPointD(pt)), this.pathOut.push(Point64Utils.fromPointD(_ClipperOffset.reflectPoint(pt, ptQ)));
    }
  }
  doMiter(path, j, k, cosA) {
    let q = this.groupDelta / (cosA + 1);
    this.pathOut.push({
      x: Math.round(path[j].x + (this.normals[k].x + this.normals[j].x) * q),
      y: Math.round(path[j].y + (this.normals[k].y + this.normals[j].y) * q)
    });
  }
  doRound(path, j, k, angle) {
    if (this.deltaCallback !== null) {
      let absDelta = Math.abs(this.groupDelta), arcTol = this.arcTolerance > 0.01 ? this.arcTolerance : absDelta * _ClipperOffset.arc_const, stepsPer360 = Math.PI / Math.acos(1 - arcTol / absDelta);
      this.stepSin = Math.sin(2 * Math.PI / stepsPer360), this.stepCos = Math.cos(2 * Math.PI / stepsPer360), this.groupDelta < 0 && (this.stepSin = -this.stepSin), this.stepsPerRad = stepsPer360 / (2 * Math.PI);
    }
    let pt = path[j], offsetVec = { x: this.normals[k].x * this.groupDelta, y: this.normals[k].y * this.groupDelta };
    j === k && PointDUtils.negate(offsetVec), this.pathOut.push({
      x: Math.round(pt.x + offsetVec.x),
      y: Math.round(pt.y + offsetVec.y)
    });
    let steps = Math.ceil(this.stepsPerRad * Math.abs(angle));
    for (let i = 1; i < steps; i++)
      offsetVec = {
        x: offsetVec.x * this.stepCos - this.stepSin * offsetVec.y,
        y: offsetVec.x * this.stepSin + offsetVec.y * this.stepCos
      }, this.pathOut.push({
        x: Math.round(pt.x + offsetVec.x),
        y: Math.round(pt.y + offsetVec.y)
      });
    this.pathOut.push(this.getPerpendic(path[j], this.normals[j]));
  }
  buildNormals(path) {
    let cnt = path.length;
    if (this.normals.length = 0, cnt !== 0) {
      for (let i = 0; i < cnt - 1; i++)
        this.normals.push(_ClipperOffset.getUnitNormal(path[i], path[i + 1]));
      this.normals.push(_ClipperOffset.getUnitNormal(path[cnt - 1], path[0]));
    }
  }
  offsetPoint(group, path, j, k) {
    if (Point64Utils.equals(path[j], path[k]))
      return;
    let sinA = InternalClipper.crossProductD(this.normals[j], this.normals[k]), cosA = InternalClipper.dotProductD(this.normals[j], this.normals[k]);
    if (sinA > 1 ? sinA = 1 : sinA < -1 && (sinA = -1), this.deltaCallback !== null && (this.groupDelta = this.deltaCallback(path, this.normals, j, k), group.pathsReversed && (this.groupDelta = -this.groupDelta)), Math.abs(this.groupDelta) < _ClipperOffset.Tolerance) {
      this.pathOut.push(path[j]);
      return;
    }
    if (cosA > -0.999 && sinA * this.groupDelta < 0)
      this.pathOut.push(this.getPerpendic(path[j], this.normals[k])), this.pathOut.push(path[j]), this.pathOut.push(this.getPerpendic(path[j], this.normals[j]));
    else if (cosA > 0.999 && this.joinType !== JoinType.Round)
      this.doMiter(path, j, k, cosA);
    else
      switch (this.joinType) {
        // miter unless the angle is sufficiently acute to exceed ML
        case JoinType.Miter:
          cosA > this.mitLimSqr - 1 ? this.doMiter(path, j, k, cosA) : this.doSquare(path, j, k);
          break;
        case JoinType.Round:
          this.doRound(path, j, k, Math.atan2(sinA, cosA));
          break;
        case JoinType.Bevel:
          this.doBevel(path, j, k);
          break;
        default:
          this.doSquare(path, j, k);
          break;
      }
  }
  offsetPolygon(group, path) {
    this.pathOut = [];
    let cnt = path.length, prev = cnt - 1;
    for (let i = 0; i < cnt; i++)
      this.offsetPoint(group, path, i, prev), prev = i;
    this.solution.push([...this.pathOut]);
  }
  offsetOpenJoined(group, path) {
    this.offsetPolygon(group, path);
    let reversePath = [...path].reverse();
    this.buildNormals(reversePath), this.offsetPolygon(group, reversePath);
  }
  offsetOpenPath(group, path) {
    this.pathOut = [];
    let highI = path.length - 1;
    if (this.deltaCallback !== null && (this.groupDelta = this.deltaCallback(path, this.normals, 0, 0)), Math.abs(this.groupDelta) < _ClipperOffset.Tolerance)
      this.pathOut.push(path[0]);
    else
      switch (this.endType) {
        case EndType.Butt:
          this.doBevel(path, 0, 0);
          break;
        case EndType.Round:
          this.doRound(path, 0, 0, Math.PI);
          break;
        default:
          this.doSquare(path, 0, 0);
          break;
      }
    for (let i = 1, k = 0; i < highI; i++)
      this.offsetPoint(group, path, i, k), k = i;
    for (let i = highI; i > 0; i--)
      this.normals[i] = { x: -this.normals[i - 1].x, y: -this.normals[i - 1].y };
    if (this.normals[0] = this.normals[highI], this.deltaCallback !== null && (this.groupDelta = this.deltaCallback(path, this.normals, highI, highI)), Math.abs(this.groupDelta) < _ClipperOffset.Tolerance)
      this.pathOut.push(path[highI]);
    else
      switch (this.endType) {
        case EndType.Butt:
          this.doBevel(path, highI, highI);
          break;
        case EndType.Round:
          this.doRound(path, highI, highI, Math.PI);
          break;
        default:
          this.doSquare(path, highI, highI);
          break;
      }
    for (let i = highI - 1, k = highI; i > 0; i--)
      this.offsetPoint(group, path, i, k), k = i;
    this.solution.push([...this.pathOut]);
  }
  doGroupOffset(group) {
    group.endType === EndType.Polygon ? (group.lowestPathIdx < 0 && (this.delta = Math.abs(this.delta)), this.groupDelta = group.pathsReversed ? -this.delta : this.delta) : this.groupDelta = Math.abs(this.delta);
    let absDelta = Math.abs(this.groupDelta);
    if (this.joinType = group.joinType, this.endType = group.endType, group.joinType === JoinType.Round || group.endType === EndType.Round) {
      let arcTol = this.arcTolerance > 0.01 ? this.arcTolerance : absDelta * _ClipperOffset.arc_const, stepsPer360 = Math.PI / Math.acos(1 - arcTol / absDelta);
      this.stepSin = Math.sin(2 * Math.PI / stepsPer360), this.stepCos = Math.cos(2 * Math.PI / stepsPer360), this.groupDelta < 0 && (this.stepSin = -this.stepSin), this.stepsPerRad = stepsPer360 / (2 * Math.PI);
    }
    for (let pathIn of group.inPaths) {
      this.pathOut = [];
      let cnt = pathIn.length;
      if (cnt === 1) {
        let pt = pathIn[0];
        if (this.deltaCallback !== null && (this.groupDelta = this.deltaCallback(pathIn, this.normals, 0, 0), group.pathsReversed && (this.groupDelta = -this.groupDelta)), group.endType === EndType.Round) {
          let steps = Math.ceil(this.stepsPerRad * 2 * Math.PI);
          this.pathOut = _ClipperOffset.ellipse(pt, Math.abs(this.groupDelta), Math.abs(this.groupDelta), steps);
        } else {
          let d = Math.ceil(Math.abs(this.groupDelta)), r = { left: pt.x - d, top: pt.y - d, right: pt.x + d, bottom: pt.y + d };
          this.pathOut = [
            { x: r.left, y: r.top },
            { x: r.right, y: r.top },
            { x: r.right, y: r.bottom },
            { x: r.left, y: r.bottom }
          ];
        }
        this.solution.push([...this.pathOut]);
        continue;
      }
      switch (cnt === 2 && group.endType === EndType.Joined && (this.endType = group.joinType === JoinType.Round ? EndType.Round : EndType.Square), this.buildNormals(pathIn), this.endType) {
        case EndType.Polygon:
          this.offsetPolygon(group, pathIn);
          break;
        case EndType.Joined:
          this.offsetOpenJoined(group, pathIn);
          break;
        default:
          this.offsetOpenPath(group, pathIn);
          break;
      }
    }
  }
  static stripDuplicates(path, isClosedPath) {
    let cnt = path.length, result = [];
    if (cnt === 0)
      return result;
    let lastPt = path[0];
    result.push(lastPt);
    for (let i = 1; i < cnt; i++)
      Point64Utils.equals(lastPt, path[i]) || (lastPt = path[i], result.push(lastPt));
    return isClosedPath && Point64Utils.equals(lastPt, result[0]) && result.pop(), result;
  }
  static area(path) {
    let a = 0, cnt = path.length;
    if (cnt < 3)
      return 0;
    let prevPt = path[cnt - 1];
    for (let pt of path)
      a += (prevPt.y + pt.y) * (prevPt.x - pt.x), prevPt = pt;
    return a * 0.5;
  }
  static sqr(val) {
    return val * val;
  }
  static ellipse(center, radiusX, radiusY = 0, steps = 0) {
    if (radiusX <= 0)
      return [];
    radiusY <= 0 && (radiusY = radiusX), steps <= 2 && (steps = Math.ceil(Math.PI * Math.sqrt((radiusX + radiusY) / 2)));
    let si = Math.sin(2 * Math.PI / steps), co = Math.cos(2 * Math.PI / steps), dx = co, dy = si, result = [{ x: Math.round(center.x + radiusX), y: center.y }];
    for (let i = 1; i < steps; ++i) {
      result.push({
        x: Math.round(center.x + radiusX * dx),
        y: Math.round(center.y + radiusY * dy)
      });
      let x = dx * co - dy * si;
      dy = dy * co + dx * si, dx = x;
    }
    return result;
  }
};
export {
  Clipper64,
  ClipperOffset
};
