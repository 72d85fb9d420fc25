// Resolution of the picture, and triangles of bodies: coarser while a slow machine plays, fine when the picture stands still.

const SLOW = 40, FAST = 20, COARSEST = 0.5;  // [ms] between pictures; pixels of the picture per pixel of the screen
const CELL = 2, LARGEST_CELL = 4;  // pixels of the picture over which points of a body in motion are drawn as one: least, and on a slow machine

class Quality {
  constructor(app) {
    this.app = app;
    this.finest = window.devicePixelRatio || 1;
    this.software = isSoftware();  // without a graphics card: no smoothing of edges by several samples, but a finer picture at rest
    this.moving = this.finest;
    this.ratio = this.resting = this.software ? 1.5 * this.finest : this.finest;
    this.cell = CELL;
    this.mean = 30;
  }

  get isMoving() { return this.app.player.playing || Boolean(this.app.camera.turning); }

  /// Chooses the triangles of flexible bodies: all of them at rest, in motion those that are seen at the resolution.
  refine() {
    const {camera, renderer} = this.app, pixel = camera.height / Math.max(renderer.domElement.height, 1);
    let changed = false;
    for (const shown of this.app.allShown)
      for (const f of shown.flexible) changed = f.detail(this.isMoving ? this.cell * pixel * camera.nearness(f.mesh.matrix) : 0) || changed;
    if (!changed) return;
    this.app.range();
    this.app.changed();
  }

  /// Adapts the resolution, and then the triangles, to the time since the last picture.
  adapt(now) {
    const passed = now - (this.before || now), playing = this.isMoving;
    this.before = now;
    if (playing) {
      this.mean += 0.15 * (Math.min(passed, 200) - this.mean);
      if (this.mean > SLOW) this.coarser();
      else if (this.mean < FAST) this.finer();
    }
    const wanted = playing ? this.moving : this.resting;
    if (Math.abs(wanted - this.ratio) < 1e-3) return;
    this.ratio = wanted;
    this.app.resize();
  }

  coarser() {
    if (this.moving > COARSEST) this.moving = Math.max(COARSEST, 0.8 * this.moving);
    else this.cell = Math.min(LARGEST_CELL, 1.25 * this.cell);
    this.mean = 30;
  }

  finer() {
    if (this.cell > CELL) this.cell = Math.max(CELL, this.cell / 1.25);
    else this.moving = Math.min(this.finest, 1.1 * this.moving);
    this.mean = 30;
  }
}

/// Tells whether the browser draws without a graphics card.
function isSoftware() {
  const context = document.createElement("canvas").getContext("webgl"), names = context && context.getExtension("WEBGL_debug_renderer_info");
  return Boolean(names) && /swiftshader|llvmpipe|software/i.test(context.getParameter(names.UNMASKED_RENDERER_WEBGL));
}
