// The player: the place between rows, which the slider, keys, events and the plot set.

const SPEEDS = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100];
const MODE_PERIOD = 1.6, LOAD_SECONDS = 6;  // [s] for a period of a mode, for all load steps, at speed 1

class Player {
  constructor(app) {
    Object.assign(this, {app, place: 0, playing: false, speed: 1, cycles: 0});
    const on = (id, what) => document.getElementById(id).addEventListener("click", what);
    on("play", () => this.toggle());
    on("first", () => this.go(0));
    on("back", () => this.step(-1));
    on("forward", () => this.step(1));
    this.slider = document.getElementById("slider");
    this.slider.addEventListener("input", () => this.go(this.fromShare(Number(this.slider.value))));
    this.loop = document.getElementById("loop");
    const select = document.getElementById("speed");
    select.append(...SPEEDS.map(speed => element("option", {value: speed, textContent: `x ${speed}`})));
    select.addEventListener("change", () => { this.speed = Number(select.value); });
  }

  /// Takes over the sequence that is shown.
  reset() {
    const {kind, events} = this.app.shown.sequence, times = this.app.shown.times, span = times.length > 1 ? times[times.length - 1] - times[0] : 0;
    this.rows = this.app.shown.sequence.rows - (kind === "mode" ? 1 : 0);
    this.last = Math.max(0, kind === "mode" ? this.rows : this.rows - 1);  // a mode goes on to its first phase
    this.byTime = kind === "time";
    this.speed = this.byTime && span > 0 ? SPEEDS.reduce((best, s) => Math.abs(Math.log(span / s / (span > 3 && span < 20 ? span : 8))) < Math.abs(Math.log(span / best / (span > 3 && span < 20 ? span : 8))) ? s : best) : 1;
    document.getElementById("speed").value = this.speed;
    document.getElementById("player").classList.toggle("away", this.last === 0);
    this.place = Math.min(this.place, this.last);
    const box = document.getElementById("events");
    box.replaceChildren(...events.filter(([t]) => this.byTime && t >= times[0] && t <= times[times.length - 1]).slice(0, 400).map(([t, name]) => {
      const mark = element("i", {title: `${name}, ${shown(t)} s`});
      mark.style.left = `${100 * (t - times[0]) / (span || 1)}%`;
      mark.addEventListener("click", () => this.seek(t));
      return mark;
    }));
  }

  toShare(place) {
    if (!this.byTime) return place / (this.last || 1);
    const times = this.app.shown.times;
    return (this.time(place) - times[0]) / ((times[times.length - 1] - times[0]) || 1);
  }

  fromShare(share) {
    if (!this.byTime) return share * this.last;
    const times = this.app.shown.times;
    return placeAt(times, times[0] + share * (times[times.length - 1] - times[0]));
  }

  time(place = this.place) {
    const times = this.app.shown.times, row = Math.min(Math.floor(place), times.length - 1), next = Math.min(row + 1, times.length - 1);
    return times.length ? times[row] + (place - row) * (times[next] - times[row]) : 0;
  }

  /// Shows a place between rows.
  go(place) {
    this.place = clamp(place, 0, this.last);
    this.app.moved();
  }

  seek(time) { this.go(placeAt(this.app.shown.times, time)); }
  step(rows) { this.pause(); this.go(rows > 0 ? Math.floor(this.place + 1e-6) + 1 : Math.ceil(this.place - 1e-6) - 1); }
  pause() { if (this.playing) this.toggle(); }

  toggle() {
    this.playing = !this.playing && this.last > 0;
    if (this.playing && this.place >= this.last) this.place = 0;
    this.before = performance.now();
    document.getElementById("play").textContent = this.playing ? "\u275A\u275A" : "\u25B6";
    document.getElementById("play").classList.toggle("on", this.playing);
    this.app.changed();
  }

  /// Goes on by the time since the last picture.
  advance(now) {
    if (!this.playing) return;
    const seconds = Math.min((now - this.before) / 1000, 0.25) * this.speed;
    this.before = now;
    let place = this.byTime ? placeAt(this.app.shown.times, this.time() + seconds) : this.place + seconds * this.last / (this.app.shown.sequence.kind === "mode" ? MODE_PERIOD : LOAD_SECONDS);
    if (place >= this.last) {
      this.cycles += this.app.shown.sequence.kind === "mode" ? 1 : 0;
      if (this.loop.checked) place = this.app.shown.sequence.kind === "mode" ? place - this.last : 0;
      else { place = this.last; this.toggle(); }
    }
    this.go(place);
  }

  moment() {
    const {kind, rows} = this.app.shown.sequence;
    if (kind === "mode") return `${Math.round(360 * this.place / this.last) % 360}\u00B0`;
    if (kind === "load") return `load factor ${shown(this.time())}`;
    if (this.app.shown.sequence.said.length) return "";  // a model that was only checked
    return rows > 1 ? `t = ${this.time().toFixed(4)} s` : `state at t = ${shown(this.time())} s`;
  }
}
