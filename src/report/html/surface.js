// Draws heights over a plane as a surface that the reader turns; buttons choose which one.
class SurfacePlot {
  constructor(node) {
    Object.assign(this, { node, width: 0, chosen: 0, azimuth: -2.12, elevation: 0.69 });
    this.data = JSON.parse(document.getElementById(node.id + "-data").textContent);
    this.data.traces.forEach((trace, i, all) => (trace.x ??= all[i - 1].x));
    this.canvas = node.querySelector("canvas");
    this.height = Number(this.canvas.getAttribute("height"));
    this.tip = node.appendChild(document.createElement("div"));
    this.tip.className = "tip";
    this.tip.hidden = true;
    const views = document.createElement("div");
    views.className = "views";
    this.buttons = this.data.traces.map(({ surface }, i) => {
      const button = views.appendChild(document.createElement("button"));
      Object.assign(button, { type: "button", textContent: surface.view.label });
      button.addEventListener("click", () => this.choose(i));
      return button;
    });
    node.prepend(views);
    this.listen();
    this.choose(0);
  }

  choose(i) {
    this.chosen = i;
    this.buttons.forEach((button, j) => button.setAttribute("aria-pressed", i === j));
    if (this.width) this.draw();
  }

  fit(width) {
    this.width = width;
    this.draw();
  }

  listen() {
    let last = null;
    this.canvas.addEventListener("pointerdown", (event) => {
      last = event;
      this.canvas.setPointerCapture(event.pointerId);
    });
    this.canvas.addEventListener("pointermove", (event) => {
      if (!last) return this.read(event);
      this.tip.hidden = true;
      this.azimuth -= 0.008 * (event.clientX - last.clientX);
      this.elevation = Math.min(1.55, Math.max(0.05, this.elevation + 0.006 * (event.clientY - last.clientY)));
      last = event;
      this.draw();
    });
    for (const end of ["pointerup", "pointercancel"]) this.canvas.addEventListener(end, () => (last = null));
    this.canvas.addEventListener("pointerleave", () => (this.tip.hidden = true));
  }

  // From a point (width, radius, height) to its place on the canvas and its nearness.
  projection({ x, y, surface: { view } }) {
    const [[a, b, c], [low, high]] = [view.drawn, view.height_range];
    const [[x0, x1], [y0, y1]] = [x, y].map((places) => [places[0], places[places.length - 1]]);
    const [sin, cos, up, flat] = [Math.sin(this.azimuth), Math.cos(this.azimuth), Math.sin(this.elevation), Math.cos(this.elevation)];
    const radius = Math.hypot(a, b) / 2;
    const scale = Math.min((this.width - 150) / (2 * radius), (this.height - 84) / (c * flat + 2 * radius * up));
    const [middleX, middleY] = [this.width / 2 - 10, this.height / 2 - 6];
    this.eye = [flat * cos, flat * sin, up];
    this.ends = { x: [x0, x1], y: [y0, y1], z: [low, high] };
    return (px, py, pz) => {
      const [u, v, w] = [a * ((px - x0) / (x1 - x0) - 0.5), b * ((py - y0) / (y1 - y0) - 0.5), c * ((pz - low) / (high - low) - 0.5)];
      return [middleX + scale * (v * cos - u * sin), middleY - scale * (w * flat - up * (u * cos + v * sin))];
    };
  }

  draw() {
    const trace = this.data.traces[this.chosen];
    const { x, y, values, surface } = trace;
    const sharp = devicePixelRatio || 1;
    Object.assign(this.canvas, { width: this.width * sharp, height: this.height * sharp });
    Object.assign(this.canvas.style, { width: `${this.width}px`, height: `${this.height}px` });
    const pen = this.canvas.getContext("2d");
    pen.scale(sharp, sharp);
    const style = getComputedStyle(document.documentElement);
    this.ink = Object.fromEntries(["ink", "rule", "muted"].map((name) => [name, style.getPropertyValue(`--${name}`)]));
    pen.font = `12px ${getComputedStyle(this.node).fontFamily}`;
    const place = this.projection(trace);
    this.places = values.map((row, j) => row.map((value, i) => (value === null ? null : place(x[i], y[j], surface.rise * value))));
    const words = this.walls(pen, place, surface);
    // From the far side to the near one.
    const order = (count, isRising) => Array.from({ length: count - 1 }, (_, k) => (isRising ? k : count - 2 - k));
    const [low, high] = surface.range;
    const colours = surface.colours;
    const columns = order(x.length, this.eye[0] > 0);
    for (const j of order(y.length, this.eye[1] > 0)) {
      for (const i of columns) {
        const corners = [this.places[j][i], this.places[j][i + 1], this.places[j + 1][i + 1], this.places[j + 1][i]];
        if (corners.includes(null)) continue;
        const [from, to] = [j, j + 1].map((row) => (values[row][i] + values[row][i + 1]) / 2);
        // In strips of about one colour.
        const strips = Math.min(24, Math.max(1, Math.ceil((colours.length / 2) * Math.abs((to - from) / (high - low)))));
        const along = (k, share) => [0, 1].map((axis) => corners[k][axis] + share * (corners[3 - k][axis] - corners[k][axis]));
        for (let strip = 0; strip < strips; strip++) {
          const [first, last] = [strip / strips, (strip + 1) / strips];
          const share = (from + (to - from) * (first + last) / 2 - low) / (high - low);
          pen.fillStyle = pen.strokeStyle = colours[Math.round(Math.min(1, Math.max(0, share)) * (colours.length - 1))];
          pen.beginPath();
          [along(0, first), along(1, first), along(1, last), along(0, last)].forEach(([px, py], k) => (k ? pen.lineTo(px, py) : pen.moveTo(px, py)));
          pen.closePath();
          pen.fill();
          pen.lineWidth = 0.6;
          pen.stroke();
        }
      }
    }
    words();
    this.colourScale(pen, surface);
  }

  // Draws the sides behind the surface and below it, with their grid; returns what writes their ticks and titles.
  walls(pen, place, { view, titles }) {
    const { x, y, z } = this.ends;
    const near = (ends, i) => (this.eye[i] > 0 ? [ends[1], ends[0]] : [ends[0], ends[1]]);
    const [[nearX, farX], [nearY, farY]] = [near(x, 0), near(y, 1)];
    const line = (...points) => {
      pen.beginPath();
      points.forEach((point, k) => (k ? pen.lineTo(...place(...point)) : pen.moveTo(...place(...point))));
      pen.stroke();
    };
    pen.lineWidth = 1;
    pen.strokeStyle = this.ink.rule;
    const marks = (ends, spacing_px, length) =>
      ticks({ names: [], ticks: [], is_logarithmic: false, spacing_px }, ends, length);
    const [alongX, alongY, alongZ] = [marks(x, 70, 400), marks(y, 70, 300), marks(z, 45, 160)];
    for (const [at] of alongX) line([at, nearY, z[0]], [at, farY, z[0]], [at, farY, z[1]]);
    for (const [at] of alongY) line([nearX, at, z[0]], [farX, at, z[0]], [farX, at, z[1]]);
    for (const [at] of alongZ) line([nearX, farY, at], [farX, farY, at], [farX, nearY, at]);
    line([x[0], y[0], z[0]], [x[1], y[0], z[0]], [x[1], y[1], z[0]], [x[0], y[1], z[0]], [x[0], y[0], z[0]]);
    line([nearX, farY, z[0]], [nearX, farY, z[1]], [farX, farY, z[1]], [farX, nearY, z[1]], [farX, nearY, z[0]]);
    return () => {
      // Words stand in front of their edge, on the way that the lines of the floor come from behind.
      const write = (text, point, behind, distance, colour) => {
        const [[px, py], [bx, by]] = [place(...point), place(...behind)];
        const length = Math.hypot(px - bx, py - by) || 1;
        pen.fillStyle = colour;
        pen.textAlign = Math.abs(px - bx) < 0.3 * length ? "center" : px < bx ? "right" : "left";
        pen.fillText(text, px + (distance * (px - bx)) / length, py + (distance * (py - by)) / length + 4);
      };
      const centre = ([from, to]) => (from + to) / 2;
      for (const [at, label] of alongX) write(label, [at, nearY, z[0]], [at, farY, z[0]], 12, this.ink.ink);
      for (const [at, label] of alongY) write(label, [nearX, at, z[0]], [farX, at, z[0]], 12, this.ink.ink);
      write(titles[0], [centre(x), nearY, z[0]], [centre(x), farY, z[0]], 44, this.ink.muted);
      write(titles[1], [nearX, centre(y), z[0]], [farX, centre(y), z[0]], 44, this.ink.muted);
      // Heights at that of both upright edges that is farther to the left.
      const edge = [[nearX, farY], [farX, nearY]].sort((one, other) => place(...one, z[0])[0] - place(...other, z[0])[0])[0];
      pen.textAlign = "right";
      pen.fillStyle = this.ink.ink;
      for (const [at, label] of alongZ) {
        const [px, py] = place(...edge, at);
        pen.fillText(label, px - 8, py + 4);
      }
      const [px, py] = place(...edge, z[1]);
      pen.fillStyle = this.ink.muted;
      pen.textAlign = "left";
      pen.fillText(view.height_title, Math.max(4, px - 60), py - 14);
    };
  }

  colourScale(pen, { range, unit, colours }) {
    const [left, top, length] = [this.width - 62, 60, this.height - 140];
    colours.forEach((colour, i) => {
      pen.fillStyle = colour;
      pen.fillRect(left, top + length - ((i + 1) * length) / colours.length, 14, length / colours.length + 0.7);
    });
    pen.fillStyle = this.ink.ink;
    pen.textAlign = "left";
    for (const [at, label] of ticks({ names: [], ticks: [], is_logarithmic: false, spacing_px: 48 }, range, length)) {
      pen.fillText(label, left + 19, top + length - (length * (at - range[0])) / (range[1] - range[0]) + 4);
    }
    pen.fillText(unit, left, top - 10);
  }

  // Says what is at the point nearest to the pointer.
  read(event) {
    const box = this.canvas.getBoundingClientRect();
    const [px, py] = [event.clientX - box.left, event.clientY - box.top];
    let best = { distance: 12 };
    this.places.forEach((row, j) =>
      row.forEach((at, i) => {
        const distance = at ? Math.hypot(at[0] - px, at[1] - py) : Infinity;
        if (distance < best.distance) best = { distance, i, j };
      }),
    );
    this.tip.hidden = best.i === undefined;
    if (this.tip.hidden) return;
    const { x, y, values: heights, surface, hover } = this.data.traces[this.chosen];
    const values = { x: x[best.i], y: y[best.j], z: surface.rise * heights[best.j][best.i] };
    const said = hover.replace("<extra></extra>", "").replace(/%\{(\w+):([^}]+)\}/g, (_, key, format) => formatted(values[key], format));
    this.tip.textContent = said.replace("<br>", ": ");
    this.tip.style.left = `${Math.min(px + 12, this.width - this.tip.offsetWidth)}px`;
    this.tip.style.top = `${py + 40}px`;
  }
}
