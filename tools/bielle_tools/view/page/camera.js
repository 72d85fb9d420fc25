// The camera: turns about a target, perspective or orthogonal, views along axes.

class Camera {
  constructor(app) {
    this.app = app;
    this.perspective = new THREE.PerspectiveCamera(32, 1, 0.01, 100);
    this.orthographic = new THREE.OrthographicCamera(-1, 1, 1, -1, -50, 100);
    this.up = upAxis(app.data.gravity);
    this.ortho = app.data.planar !== null;
    this.target = [0, 0, 0];
    this.height = 1;  // of the scene in the middle of the picture
    this.watch(document.getElementById("scene"));
    this.view(app.data.planar === null ? "iso" : "xyz"[app.data.planar]);
  }

  get active() { return this.ortho ? this.orthographic : this.perspective; }

  /// Directions to the right, up, and towards the viewer.
  axes() {
    const [e, f, u] = [this.east(), this.north(), this.upward()];
    const c = Math.cos(this.tilt), back = [0, 1, 2].map(k => c * (Math.sin(this.turn) * e[k] - Math.cos(this.turn) * f[k]) + Math.sin(this.tilt) * u[k]);
    const right = [0, 1, 2].map(k => Math.cos(this.turn) * e[k] + Math.sin(this.turn) * f[k]);
    return [right, cross(back, right), back];
  }

  upward() { return [0, 1, 2].map(k => k === this.up ? 1 : 0); }
  east() { return [0, 1, 2].map(k => k === (this.up + 1) % 3 ? 1 : 0); }
  north() { return [0, 1, 2].map(k => k === (this.up + 2) % 3 ? 1 : 0); }

  /// A named view; the whole machine fills the picture.
  view(name) {
    const axis = "xyz".indexOf(name);
    if (axis < 0) [this.turn, this.tilt] = [0.62, 0.42];
    else if (axis === this.up) [this.turn, this.tilt] = [0, Math.PI / 2];
    else [this.turn, this.tilt] = [axis === (this.up + 1) % 3 ? Math.PI / 2 : 0, 0];
    this.fit();
  }

  /// Moves and sizes the picture so that all points of the motion are in it.
  fit() {
    if (!this.app.shown) return;
    this.touched = false;
    const aspect = this.aspect(), tangent = Math.tan(16 * Math.PI / 180), axes = this.axes(), [right, up] = axes;
    const points = this.app.extent().map(p => axes.map(axis => dot(p, axis)));  // to the right, up, towards the viewer
    this.target = this.app.data.low.map((x, k) => (x + this.app.data.high[k]) / 2);
    this.height = 3;
    for (let round = 0; round < 6; round++) {
      const distance = this.height / 2 / tangent;
      const [right0, up0, back0] = axes.map(axis => dot(this.target, axis));
      let left = Infinity, most = -Infinity, bottom = Infinity, top = -Infinity;
      for (const p of points) {
        const nearer = this.ortho ? 1 : distance / Math.max(distance - (p[2] - back0), 0.1 * distance), x = (p[0] - right0) * nearer, y = (p[1] - up0) * nearer;
        left = Math.min(left, x);
        most = Math.max(most, x);
        bottom = Math.min(bottom, y);
        top = Math.max(top, y);
      }
      if (!(most >= left)) break;
      this.target = this.target.map((value, k) => value + (left + most) / 2 * right[k] + (bottom + top) / 2 * up[k]);
      this.height = clamp(1.1 * Math.max(top - bottom, (most - left) / aspect, 0.01), this.height / 4, this.height * 4);
    }
    this.app.changed();
  }

  /// Distance of the origin of a matrix from the viewer relative to that of the target, at least 0.1; 1 if distances do not matter.
  nearness(matrix) {
    if (this.ortho) return 1;
    const p = this.perspective.position, m = matrix.elements, distance = this.height / 2 / Math.tan(16 * Math.PI / 180);
    return Math.max(0.1, Math.hypot(m[12] - p.x, m[13] - p.y, m[14] - p.z) / distance);
  }

  aspect() {
    const stage = document.getElementById("stage");
    return Math.max(stage.clientWidth, 1) / Math.max(stage.clientHeight, 1);
  }

  place(follow) {
    const [right, up, back] = this.axes(), aspect = this.aspect(), distance = this.height / 2 / Math.tan(16 * Math.PI / 180);
    const target = follow ? follow.map((x, k) => x + this.target[k]) : this.target;
    for (const camera of [this.perspective, this.orthographic]) {
      camera.up.set(...up);
      camera.position.set(...target.map((x, k) => x + distance * back[k]));
      camera.lookAt(...target);
    }
    Object.assign(this.orthographic, {left: -aspect * this.height / 2, right: aspect * this.height / 2, top: this.height / 2, bottom: -this.height / 2, near: -20, far: 40 + distance});
    Object.assign(this.perspective, {aspect, near: Math.max(distance / 200, 1e-4), far: distance + 20});
    this.active.updateProjectionMatrix();
    this.active.updateMatrixWorld();
  }

  watch(canvas) {
    let from = null, moved = 0;
    canvas.addEventListener("contextmenu", event => event.preventDefault());
    canvas.addEventListener("pointerdown", event => { from = [event.clientX, event.clientY]; moved = 0; this.turning = true; canvas.setPointerCapture(event.pointerId); });
    canvas.addEventListener("pointermove", event => {
      if (!from) return;
      const dx = event.clientX - from[0], dy = event.clientY - from[1];
      from = [event.clientX, event.clientY];
      moved += Math.abs(dx) + Math.abs(dy);
      this.touched = true;
      if (event.buttons === 1 && !event.shiftKey) {
        this.turn -= 0.008 * dx;
        this.tilt = clamp(this.tilt + 0.008 * dy, -Math.PI / 2, Math.PI / 2);
      } else this.pan(dx, dy);
      this.app.changed();
    });
    canvas.addEventListener("pointerup", event => {
      from = null;
      this.turning = false;
      this.app.changed();
      if (moved < 4 && event.button === 0) this.app.picking.click(event.offsetX, event.offsetY);
    });
    canvas.addEventListener("wheel", event => {
      event.preventDefault();
      this.touched = true;
      const factor = Math.exp(0.0012 * clamp(event.deltaY, -300, 300)), rect = canvas.getBoundingClientRect(), [right, up] = this.axes();
      const x = event.clientX - rect.left - rect.width / 2, y = event.clientY - rect.top - rect.height / 2, unit = this.height / rect.height * (1 - factor);
      this.target = this.target.map((value, k) => value + unit * (x * right[k] - y * up[k]));
      this.height = clamp(this.height * factor, 1e-5, 20);
      this.app.changed();
    }, {passive: false});
  }

  pan(dx, dy) {
    const unit = this.height / document.getElementById("stage").clientHeight, [right, up] = this.axes();
    this.target = this.target.map((value, k) => value + unit * (dy * up[k] - dx * right[k]));
  }

  /// Pixels of a point of the scene, and whether it is before the viewer.
  pixels(p) {
    const v = new THREE.Vector3(...p).project(this.active), stage = document.getElementById("stage");
    return [(v.x + 1) / 2 * stage.clientWidth, (1 - v.y) / 2 * stage.clientHeight, v.z < 1];
  }

  saved() { return {turn: this.turn, tilt: this.tilt, ortho: this.ortho, target: this.target, height: this.height}; }
}

/// 0, 1, 2: the axis against gravity; z without gravity.
function upAxis(gravity) {
  if (!gravity) return 2;
  const sizes = gravity.map(Math.abs);
  return sizes.indexOf(Math.max(...sizes));
}
