// A page of a growing run: asks its own server whether the file changed, and loads itself again with the same view.

const LIVE_EVERY = 1000;  // [ms]

class Live {
  constructor(app) {
    this.app = app;
    this.restore();
    setInterval(() => this.ask(), LIVE_EVERY);
  }

  async ask() {
    try {
      const token = await (await fetch("/state", {cache: "no-store"})).text(), {app} = this;
      if (token === app.data.live) return;
      sessionStorage.setItem("bielle-view", JSON.stringify({camera: app.camera.saved(), last: app.player.place >= app.player.last, place: app.player.place, sequence: app.number, series: app.plot.series}));
      location.reload();
    } catch (error) {
      document.getElementById("moment").title = "the server has ended";
    }
  }

  restore() {
    const text = sessionStorage.getItem("bielle-view"), {app} = this;
    if (!text) return;
    const saved = JSON.parse(text);
    if (saved.sequence < app.data.runs[0].sequences.length) app.show(saved.sequence);
    Object.assign(app.camera, saved.camera, {touched: true});
    app.plot.series = saved.series;
    app.plot.refill();
    app.player.go(saved.last ? app.player.last : saved.place);
  }
}
