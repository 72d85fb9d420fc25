// Shaders: rigid parts on bones of a texture, flexible bodies with their own points, one light for both.

const HIDDEN = 0.002, CLEAR = 0.995;  // opacity up to which a part is not drawn, and from which nothing is seen through it

const LIGHT = `
  vec3 lit(vec3 base, vec3 normal) {
    vec3 n = normalize(normal);
    if (n.z < 0.0) n = -n;
    float key = max(dot(n, normalize(vec3(0.35, 0.65, 0.75))), 0.0), fill = max(dot(n, normalize(vec3(-0.7, 0.1, 0.5))), 0.0);
    float shine = pow(max(dot(n, normalize(vec3(0.2, 0.4, 1.0))), 0.0), 40.0);
    return base * (0.50 + 0.42 * key + 0.14 * fill + 0.12 * n.z) + vec3(0.08 * shine);
  }`;

const TEXEL = `
  vec4 texel(sampler2D table, vec2 size, float index) {
    float row = floor((index + 0.5) / size.x);
    return texture2D(table, (vec2(index - row * size.x, row) + 0.5) / size);
  }`;

const STRESSED = `
  uniform sampler2D scale;
  uniform vec2 range;
  varying float vValue;
  vec3 stressed(vec3 plain) {
    float share = (vValue - range.x) / max(range.y - range.x, 1e-30);
    return vValue < -1e29 || range.y <= range.x ? plain : texture2D(scale, vec2(clamp(share, 0.002, 0.998), 0.5)).rgb;
  }`;

const PLACED = `
  uniform sampler2D bones, looks;
  uniform vec2 boneSize, lookSize;
  attribute float bone, owner;
  ${TEXEL}
  vec3 turned(vec4 q, vec3 p) { vec3 t = 2.0 * cross(q.yzw, p); return p + q.x * t + cross(q.yzw, t); }
  vec4 stretched() { return texel(bones, boneSize, 2.0 * bone); }
  vec4 rotation() { return texel(bones, boneSize, 2.0 * bone + 1.0); }`;

const RIGID_VERTEX = `
  ${PLACED}
  uniform float clear;
  uniform sampler2D stresses;
  uniform vec2 stressSize;
  attribute float cell;
  varying float vValue;
  varying vec3 vNormal;
  varying vec4 vLook;
  void main() {
    vec4 a = stretched(), q = rotation();
    vLook = texel(looks, lookSize, owner);
    vValue = cell < 0.0 ? -1e30 : texel(stresses, stressSize, cell).r;
    vec3 p = a.xyz + turned(q, vec3(position.xy, position.z * a.w));
    vNormal = normalMatrix * turned(q, vec3(normal.xy * a.w, normal.z));
    bool mine = vLook.a > ${HIDDEN} && (vLook.a < ${CLEAR}) == (clear > 0.5);
    gl_Position = mine ? projectionMatrix * modelViewMatrix * vec4(p, 1.0) : vec4(0.0, 0.0, 2.0, 1.0);
  }`;

const RIGID_FRAGMENT = `
  varying vec3 vNormal;
  varying vec4 vLook;
  ${STRESSED}
  ${LIGHT}
  void main() { gl_FragColor = vec4(lit(stressed(vLook.rgb), vNormal), vLook.a); }`;

const LINE_FRAGMENT = `
  varying vec4 vLook;
  void main() { gl_FragColor = vec4(vLook.rgb * 0.75, min(1.0, 1.6 * vLook.a)); }`;

const PICK_VERTEX = `
  ${PLACED}
  uniform float first;
  varying vec3 vCode;
  void main() {
    vec4 a = stretched(), q = rotation(), look = texel(looks, lookSize, owner);
    float number = owner + first;
    vCode = vec3(mod(number, 256.0), mod(floor(number / 256.0), 256.0), floor(number / 65536.0)) / 255.0;
    vec3 p = a.xyz + turned(q, vec3(position.xy, position.z * a.w));
    gl_Position = look.a > ${HIDDEN} ? projectionMatrix * modelViewMatrix * vec4(p, 1.0) : vec4(0.0, 0.0, 2.0, 1.0);
  }`;

const PICK_FRAGMENT = `
  varying vec3 vCode;
  void main() { gl_FragColor = vec4(vCode, 1.0); }`;

const FLEXIBLE_VERTEX = `
  attribute float value;
  varying float vValue;
  varying vec3 vView;
  void main() {
    vValue = value;
    vec4 view = modelViewMatrix * vec4(position, 1.0);
    vView = view.xyz;
    gl_Position = projectionMatrix * view;
  }`;

const FLEXIBLE_FRAGMENT = `
  uniform vec4 look;
  varying vec3 vView;
  ${STRESSED}
  ${LIGHT}
  void main() {
    vec3 n = cross(dFdx(vView), dFdy(vView));
    gl_FragColor = vec4(lit(stressed(look.rgb), length(n) > 0.0 ? n : vec3(0.0, 0.0, 1.0)), look.a);
  }`;
