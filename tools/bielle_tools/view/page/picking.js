// Identification of the part under the pointer: numbers of parts drawn as colours, then the nearest triangle of that part.

class Picking {
  constructor(app) {
    this.app = app;
    this.target = new THREE.WebGLRenderTarget(1, 1);
    this.scene = new THREE.Scene();
  }

  click(x, y) {
    const found = this.at(x, y);
    if (!found) { this.app.entries.choose(null); return; }
    this.app.entries.choose(found.entry, found);
  }

  /// {entry, track, local: point in the axes of the track} or null.
  at(x, y) {
    const {shown, renderer} = this.app, camera = this.app.camera.active, stage = document.getElementById("stage"), pixel = new Uint8Array(4);
    this.scene.children.length = 0;
    this.scene.add(shown.batch.pickable);
    const flexible = shown.flexible.filter(f => f.mesh.visible && f.look.w > HIDDEN), plain = flexible.map(f => f.mesh.material);
    flexible.forEach((f, k) => { f.mesh.material = this.numbered(1 + shown.batch.parts.length + k); this.scene.children.push(f.mesh); });
    camera.setViewOffset(stage.clientWidth, stage.clientHeight, x, y, 1, 1);
    renderer.setRenderTarget(this.target);
    renderer.setClearColor(0x000000, 1);
    renderer.clear();
    renderer.render(this.scene, camera);
    renderer.readRenderTargetPixels(this.target, 0, 0, 1, 1, pixel);
    renderer.setRenderTarget(null);
    renderer.setClearColor(0x000000, 0);
    camera.clearViewOffset();
    flexible.forEach((f, k) => { f.mesh.material.dispose(); f.mesh.material = plain[k]; });
    this.scene.children.length = 0;
    const number = pixel[0] + 256 * pixel[1] + 65536 * pixel[2] - 1, parts = shown.batch.parts;
    if (number < 0) return null;
    const ray = this.ray(x, y);
    return number < parts.length ? this.rigid(number, ray) : this.bent(flexible[number - parts.length], ray);
  }

  numbered(number) {
    return new THREE.MeshBasicMaterial({color: new THREE.Color((number & 255) / 255, (number >> 8 & 255) / 255, (number >> 16) / 255), side: THREE.DoubleSide});
  }

  ray(x, y) {
    const stage = document.getElementById("stage"), caster = new THREE.Raycaster();
    caster.setFromCamera(new THREE.Vector2(2 * x / stage.clientWidth - 1, 1 - 2 * y / stage.clientHeight), this.app.camera.active);
    return caster.ray;
  }

  rigid(number, ray) {
    const b = this.app.shown.batch, hit = this.nearest(b.triangles, ray, k => b.corner(k), k => b.owners[k] === number);
    const track = hit ? b.boneOf[hit.corner] : b.parts[number].track;
    return {entry: b.parts[number].entry, type: b.parts[number].type, track, local: hit ? this.local(track, hit.point) : [0, 0, 0], world: hit && hit.point, cell: hit ? b.cellOf[hit.corner] : -1};
  }

  bent(f, ray) {
    const hit = this.nearest(f.body.triangles, ray, k => f.corner(k), () => true);
    return {entry: f.part.entry, type: f.part.type, flexible: f, corner: hit ? hit.corner : 0, node: hit ? f.body.nodes[hit.corner] : 0, track: f.part.track, world: hit && hit.point};
  }

  /// Nearest triangle along a ray: {point, corner}: the corner next to the point.
  nearest(triangles, ray, corner, wanted) {
    let best = null, least = Infinity;
    const v = [0, 1, 2].map(() => new THREE.Vector3()), at = new THREE.Vector3();
    for (let k = 0; k < triangles.length; k += 3) {
      if (!wanted(triangles[k])) continue;
      v.forEach((p, i) => p.set(...corner(triangles[k + i])));
      if (!ray.intersectTriangle(v[0], v[1], v[2], false, at)) continue;
      const distance = at.distanceTo(ray.origin);
      if (distance < least) {
        least = distance;
        const gaps = v.map(p => p.distanceTo(at));
        best = {point: at.toArray(), corner: triangles[k + gaps.indexOf(Math.min(...gaps))]};
      }
    }
    return best;
  }

  /// Point of the scene -> axes of a track now.
  local(track, point) {
    const p = this.app.shown.tracks.poses, s = 8 * track, d = minus(point, [p[s], p[s + 1], p[s + 2]]);
    const r = rotate(p[s + 4], -p[s + 5], -p[s + 6], -p[s + 7], d);
    return [r[0], r[1], r[2] / (p[s + 3] || 1)];
  }
}
