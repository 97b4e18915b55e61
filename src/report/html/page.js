// Lets the reader of a page look closer at its plots: fits each to its room, enlarges a part of it, reads its points, shows and hides its
// traces and moves its slider. The drawing itself stands in the page as SVG; what is changed is where its parts are.
(() => {
  "use strict";
  const PRINT_WIDTH = 670; // px: an A4 page less its margins
  const PRINT_WIDTH_BESIDE = 532; // px: of plots beside one another, which are made smaller then
  const NEAR = 40; // px from a point at which it is read
  const LEAST_FRAME = 6; // px: a smaller one is a click
  const root = document.documentElement;
  const svgElement = (name, attributes) => {
    const element = document.createElementNS(document.querySelector(".plot svg").namespaceURI, name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    return element;
  };
  const element = (name, className, text) => {
    const made = document.createElement(name);
    made.className = className;
    made.textContent = text;
    return made;
  };

  class Plot {
    constructor(node) {
      this.node = node;
      this.data = JSON.parse(document.getElementById(node.id + "-data").textContent);
      this.data.traces.forEach((trace, i, all) => (trace.x ??= all[i - 1].x));
      this.svg = node.querySelector("svg");
      this.shown = this.data.traces.map((trace) => trace.is_shown);
      this.groups = this.data.traces.map((_, i) => node.querySelector(`.trace[data-trace="${i}"]`));
      this.turned = new Map(); // groups that a slider turns: angle and centre
      this.view = null; // ranges of x and y that the reader chose
      this.width = 0;
      this.frame = this.data.frame;
      this.at = null; // value of its slider, where it has been moved
      // Where each part was drawn.
      for (const part of node.querySelectorAll(".at, .at-x, .at-y")) {
        part.drawn = /translate\(([^,]+),([^)]+)\)/.exec(part.getAttribute("transform")).slice(1).map(Number);
      }
      this.tip = node.appendChild(element("div", "tip", ""));
      this.tip.hidden = true;
      this.listen();
      this.addTools();
    }

    // The part of the plot that is shown, both ranges in coordinates, at its true proportions where those matter.
    ranges() {
      const { x, y, is_to_scale } = this.data;
      const ranges = this.view || { x: x.asked, y: y.asked };
      if (!is_to_scale) return ranges;
      const [left, top, right, bottom] = this.frame;
      const unit = Math.min((right - left) / Math.abs(ranges.x[1] - ranges.x[0]), (bottom - top) / Math.abs(ranges.y[1] - ranges.y[0]));
      const wide = ([from, to], length) => [(from + to - length / unit) / 2, (from + to + length / unit) / 2];
      return { x: wide(ranges.x, right - left), y: wide(ranges.y, bottom - top) };
    }

    fit(width) {
      const { size, frame } = this.data;
      this.width = width;
      const farther = width - size[0];
      this.frame = [frame[0], frame[1], Math.max(frame[2] + farther, frame[0] + 40), frame[3]];
      this.svg.setAttribute("viewBox", `0 0 ${width} ${size[1]}`);
      const [left, top, right, bottom] = this.frame;
      this.svg.querySelector("clipPath rect").setAttribute("width", right - left);
      this.svg.querySelector(".corner path").setAttribute("d", `M${left} ${top}V${bottom}H${right}`);
      this.svg.querySelector(".titles text").setAttribute("x", (left + right) / 2);
      for (const scale of this.svg.querySelectorAll(".scale, .beside")) scale.setAttribute("transform", `translate(${farther},0)`);
      this.place();
    }

    // From places as drawn to places as shown: a factor and a shift for each direction.
    moves() {
      const { x, y, frame } = this.data;
      const [left, top, right, bottom] = this.frame;
      const ranges = this.shownRanges = this.ranges();
      const along = (drawn, shown, [from, to], [newFrom, newTo]) => {
        const scale = (newTo - newFrom) / (shown[1] - shown[0]);
        const factor = (scale * (drawn[1] - drawn[0])) / (to - from);
        return [factor, newFrom + scale * (drawn[0] - shown[0]) - factor * from];
      };
      return [along(x.range, ranges.x, [frame[0], frame[2]], [left, right]), along(y.range, ranges.y, [frame[3], frame[1]], [bottom, top])];
    }

    // Puts everything where the frame and the ranges want it.
    place() {
      const [[fx, sx], [fy, sy]] = this.moves();
      const [left, top, right, bottom] = this.frame;
      this.groups.forEach((group, i) => {
        if (!group) return;
        const turn = this.turned.get(i) || "";
        const matrix = `matrix(${fx},0,0,${fy},${sx},${sy}) ${turn}`;
        for (const part of group.children) {
          if (part.drawn) part.setAttribute("transform", `translate(${fx * part.drawn[0] + sx},${fy * part.drawn[1] + sy})`);
          else part.setAttribute("transform", matrix);
        }
      });
      const put = (part, x, y, isInside) => {
        part.setAttribute("transform", `translate(${x},${y})`);
        part.style.display = isInside ? "" : "none";
      };
      for (const part of this.svg.querySelectorAll(".above .at")) put(part, fx * part.drawn[0] + sx, fy * part.drawn[1] + sy, true);
      for (const part of this.svg.querySelectorAll(".at-x")) {
        const x = fx * part.drawn[0] + sx;
        put(part, x, part.drawn[1], x >= left - 0.5 && x <= right + 0.5);
      }
      for (const part of this.svg.querySelectorAll(".at-y")) {
        const y = fy * (part.drawn[1] - 4) + sy;
        put(part, part.drawn[0], y + 4, y >= top - 1 && y <= bottom + 1);
      }
      this.clear();
      this.axes();
    }

    // Hides labels that would stand on others.
    clear() {
      const boxes = [];
      for (const label of this.svg.querySelectorAll(".trace text")) {
        const [, x, y] = /translate\(([^,]+),([^)]+)\)/.exec(label.getAttribute("transform")).map(Number);
        const half = 0.3 * label.getAttribute("font-size") * label.textContent.length + 2;
        const isFree = boxes.every(([otherX, otherY, other]) => Math.abs(x - otherX) > half + other || Math.abs(y - otherY) > 14);
        label.style.display = isFree ? "" : "none";
        if (isFree) boxes.push([x, y, half]);
      }
    }

    // Place on the plot of a coordinate.
    px(axis, coordinate) {
      const [left, top, right, bottom] = this.frame;
      const [from, to] = this.shownRanges[axis];
      const share = (coordinate - from) / (to - from);
      return axis === "x" ? left + share * (right - left) : bottom + share * (top - bottom);
    }

    coordinate(axis, px) {
      const [left, top, right, bottom] = this.frame;
      const [from, to] = this.shownRanges[axis];
      return from + (to - from) * (axis === "x" ? (px - left) / (right - left) : (px - bottom) / (top - bottom));
    }

    axes() {
      const [left, top, right, bottom] = this.frame;
      const [grid, rule] = ["var(--grid)", "var(--rule)"];
      const parts = [];
      const line = (d, stroke) => parts.push(svgElement("path", { d, fill: "none", stroke }));
      const word = (text, x, y, anchor) => {
        const one = svgElement("text", { x, y, "text-anchor": anchor, "font-size": 12, fill: "var(--ink)" });
        one.textContent = text;
        parts.push(one);
      };
      for (const [place, label] of ticks(this.data.x, this.shownRanges.x, right - left)) {
        const x = this.px("x", place);
        if (this.data.x.has_grid) line(`M${x} ${top}V${bottom}`, grid);
        line(`M${x} ${bottom}v4`, rule);
        word(label, x, bottom + 18, "middle");
      }
      for (const [place, label] of ticks(this.data.y, this.shownRanges.y, bottom - top)) {
        const y = this.px("y", place);
        if (this.data.y.has_grid) line(`M${left} ${y}H${right}`, grid);
        line(`M${left} ${y}h-4`, rule);
        const lines = label.split("\n");
        lines.forEach((text, i) => word(text, left - 8, y + 4 + 14 * (i - (lines.length - 1) / 2), "end"));
      }
      this.svg.querySelector(".axes").replaceChildren(...parts);
    }

    show(traces, isShown) {
      for (const i of traces) {
        this.shown[i] = isShown;
        if (this.groups[i]) this.groups[i].setAttribute("display", isShown ? "inline" : "none");
        const entry = this.entries().find((one) => Number(one.dataset.trace) === i);
        if (entry) entry.setAttribute("aria-pressed", isShown);
      }
    }

    entries() {
      return [...this.node.parentNode.querySelectorAll(".legend button")];
    }

    // The traces that an entry of the legend stands for.
    together(entry) {
      const i = Number(entry.dataset.trace);
      const { group } = this.data.traces[i];
      return group === null ? [i] : this.data.traces.flatMap((trace, j) => (trace.group === group ? [j] : []));
    }

    zoom(x, y) {
      // Narrower than numbers can tell apart, nothing is to be seen.
      const isTold = ([from, to]) => Math.abs(to - from) > 1e-9 * Math.max(Math.abs(from), Math.abs(to));
      if (!isTold(x) || !isTold(y)) return;
      this.view = { x, y };
      this.hide();
      this.place();
    }

    // By a factor about a place.
    magnify(factor, px = (this.frame[0] + this.frame[2]) / 2, py = (this.frame[1] + this.frame[3]) / 2) {
      const about = (axis, place) => {
        const middle = this.coordinate(axis, place);
        return this.shownRanges[axis].map((end) => middle + (end - middle) / factor);
      };
      this.zoom(about("x", px), about("y", py));
    }

    // As it was; from there to all there is.
    reset() {
      const whole = { x: this.data.x.whole, y: this.data.y.whole };
      const { y } = this.data;
      // Depths grow downwards, all of them too.
      if (y.range[0] > y.range[1]) whole.y = [...whole.y].reverse();
      this.view = this.view ? null : whole;
      this.hide();
      this.place();
    }

    addTools() {
      const tools = element("div", "tools", "");
      const tool = (text, name, act) => {
        const button = tools.appendChild(element("button", "", text));
        button.type = "button";
        button.title = name;
        button.setAttribute("aria-label", name);
        button.addEventListener("click", act);
      };
      tool("+", "enlarge", () => this.magnify(1.5));
      tool("−", "reduce", () => this.magnify(1 / 1.5));
      tool("⟲", "as it was, then all there is", () => this.reset());
      tool("⤓", "save as PNG", () => this.save());
      this.node.append(tools);
    }

    // The drawing with its colours in force and its legend, as a picture of twice its size.
    save() {
      const SCALE = 2;
      const copy = this.svg.cloneNode(true);
      const width = this.width;
      const height = this.data.size[1] + this.addLegend(copy);
      const attributes = { width: SCALE * width, height: SCALE * height, viewBox: `0 0 ${width} ${height}` };
      Object.entries(attributes).forEach(([key, value]) => copy.setAttribute(key, value));
      // Widths of lines are those of the screen, whatever the scale.
      for (const path of copy.querySelectorAll(".trace path:not(.at)")) {
        path.setAttribute("vector-effect", "non-scaling-stroke");
        for (const name of ["stroke-width", "stroke-dasharray"]) {
          const lengths = path.getAttribute(name);
          if (lengths) path.setAttribute(name, lengths.split(" ").map((length) => SCALE * length).join(" "));
        }
      }
      const style = getComputedStyle(root);
      const used = new Set(copy.outerHTML.match(/--[\w-]+/g));
      copy.style.cssText = [...used].map((name) => `${name}: ${style.getPropertyValue(name)}`).join(";") + ";font-family: sans-serif";
      copy.prepend(svgElement("rect", { width, height, fill: style.getPropertyValue("--paper") }));
      const picture = new Image();
      picture.onload = () => {
        const canvas = Object.assign(document.createElement("canvas"), { width: SCALE * width, height: SCALE * height });
        canvas.getContext("2d").drawImage(picture, 0, 0);
        Object.assign(document.createElement("a"), { href: canvas.toDataURL("image/png"), download: `${this.node.id}.png` }).click();
      };
      picture.src = "data:image/svg+xml;charset=utf-8," + encodeURIComponent(new XMLSerializer().serializeToString(copy));
    }

    // Puts the legend below a copy of the drawing; returns its height.
    addLegend(copy) {
      const shown = this.entries().filter((entry) => entry.getAttribute("aria-pressed") === "true");
      let [x, y] = [this.frame[0], this.data.size[1] + 4];
      for (const entry of shown) {
        const length = 46 + 7.2 * entry.textContent.length;
        if (x > this.frame[0] && x + length > this.width) [x, y] = [this.frame[0], y + 20];
        const sign = entry.querySelector("svg").cloneNode(true);
        Object.entries({ x, y, width: 30, height: 14 }).forEach(([key, value]) => sign.setAttribute(key, value));
        const name = svgElement("text", { x: x + 36, y: y + 11, "font-size": 12, fill: "var(--ink)" });
        name.textContent = entry.textContent;
        copy.append(sign, name);
        x += length;
      }
      return shown.length ? y + 24 - this.data.size[1] : 0;
    }

    // Place of a pointer on the drawing.
    at_pointer(event) {
      const box = this.svg.getBoundingClientRect();
      return [((event.clientX - box.left) * this.width) / box.width, ((event.clientY - box.top) * this.data.size[1]) / box.height];
    }

    isInside([x, y]) {
      const [left, top, right, bottom] = this.frame;
      return x >= left && x <= right && y >= top && y <= bottom;
    }

    listen() {
      const { svg } = this;
      let start = null; // of a drag
      let box = null;
      svg.addEventListener("pointerdown", (event) => {
        const at = this.at_pointer(event);
        if (event.button !== 0 || event.pointerType === "touch" || !this.isInside(at)) return;
        event.preventDefault();
        start = { at, ranges: this.shownRanges, isPan: this.data.is_dragged !== event.shiftKey };
        svg.setPointerCapture(event.pointerId);
      });
      svg.addEventListener("pointermove", (event) => {
        const at = this.at_pointer(event);
        if (!start) return this.isInside(at) ? this.read(at) : this.hide();
        this.hide();
        if (start.isPan) {
          const shifted = (axis, i) => {
            const [from, to] = start.ranges[axis];
            const length = i ? this.frame[1] - this.frame[3] : this.frame[2] - this.frame[0];
            const by = ((at[i] - start.at[i]) / length) * (to - from);
            return [from - by, to - by];
          };
          return this.zoom(shifted("x", 0), shifted("y", 1));
        }
        box = box || svg.appendChild(svgElement("rect", { class: "box" }));
        const [left, top, right, bottom] = this.frame;
        const end = [Math.min(Math.max(at[0], left), right), Math.min(Math.max(at[1], top), bottom)];
        const sides = { x: Math.min(start.at[0], end[0]), y: Math.min(start.at[1], end[1]), width: Math.abs(end[0] - start.at[0]), height: Math.abs(end[1] - start.at[1]) };
        for (const [key, value] of Object.entries(sides)) box.setAttribute(key, value);
        box.sides = sides;
      });
      svg.addEventListener("pointerup", () => {
        if (box) {
          const { x, y, width, height } = box.sides;
          box.remove();
          if (width > LEAST_FRAME || height > LEAST_FRAME) {
            // A narrow frame enlarges in one direction.
            const range = (axis, from, to, length) =>
              length > LEAST_FRAME ? [this.coordinate(axis, from), this.coordinate(axis, to)] : this.shownRanges[axis];
            this.zoom(range("x", x, x + width, width), range("y", y + height, y, height));
          }
        }
        [start, box] = [null, null];
      });
      svg.addEventListener("pointerleave", () => this.hide());
      svg.addEventListener("dblclick", (event) => this.isInside(this.at_pointer(event)) && this.reset());
      svg.addEventListener(
        "wheel",
        (event) => {
          if (!event.ctrlKey) return; // the wheel alone scrolls the page
          event.preventDefault();
          this.magnify(Math.exp(-0.004 * event.deltaY), ...this.at_pointer(event));
        },
        { passive: false },
      );
      for (const entry of this.entries()) {
        entry.addEventListener("click", () => this.show(this.together(entry), entry.getAttribute("aria-pressed") !== "true"));
        entry.addEventListener("dblclick", () => {
          const others = this.entries().filter((other) => other !== entry).flatMap((other) => this.together(other));
          const isAlone = others.every((i) => !this.shown[i]);
          this.show(others, isAlone);
          this.show(this.together(entry), true);
        });
      }
    }

    // Points of a trace nearest to a place: number, distance and place.
    nearest(trace, [px, py], isAcrossOnly) {
      let best = null;
      const coordinate = (axis, value) => (this.data[axis].is_logarithmic ? Math.log10(value) : value);
      for (let i = 0; i < trace.x.length; i++) {
        if (trace.x[i] === null || trace.y[i] === null) continue;
        const x = this.px("x", coordinate("x", trace.x[i]));
        const y = this.px("y", coordinate("y", trace.y[i]));
        const distance = isAcrossOnly ? Math.abs(x - px) : Math.hypot(x - px, y - py);
        if (distance < (best ? best.distance : NEAR) && this.isInside([x, Math.min(Math.max(y, this.frame[1]), this.frame[3])])) {
          best = { i, distance, at: [x, y] };
        }
      }
      return best;
    }

    // The cell of a field at a place.
    cell(trace, state, at) {
      const values = state !== null && trace.values && this.data.control && this.data.control.steps ? this.data.control.steps[state].change.cells || trace.values : trace.values;
      const [x, y] = [this.coordinate("x", at[0]), this.coordinate("y", at[1])];
      const isCells = trace.x.length > values[0].length;
      const index = (places, value) => (isCells ? places.findIndex((edge) => edge > value) - 1 : this.closest(places, value));
      const log = (axis, places) => (this.data[axis].is_logarithmic ? places.map(Math.log10) : places);
      const [i, j] = [index(log("x", trace.x), x), index(log("y", trace.y), y)];
      const value = i >= 0 && j >= 0 && values[j] ? values[j][i] : null;
      if (value === null || value === undefined) return null;
      const middle = (places, k) => (isCells ? (places[k] + places[k + 1]) / 2 : places[k]);
      return { x: middle(trace.x, i), y: middle(trace.y, j), z: value };
    }

    closest(places, value) {
      return places.reduce((best, place, i) => (Math.abs(place - value) < Math.abs(places[best] - value) ? i : best), 0);
    }

    // A template with the values of a point.
    said(trace, values) {
      return trace.hover
        .replace(/<extra><\/extra>/, "")
        .replace(/%\{(\w+)(?::([^}]+))?\}/g, (_, key, format) => {
          const value = values[key];
          if (typeof value === "string") return value;
          const { names } = this.data[key] || {};
          if (names && names.length) return names[Math.round(value)].replace("\n", "");
          const given = this.data[key] && this.data[key].ticks.find(([place]) => place === value);
          return !format && given ? given[1] : formatted(value, format || (this.data[key] && this.data[key].format));
        })
        .split("<br>");
    }

    values(trace, i) {
      return { x: trace.x[i], y: trace.y[i], text: trace.texts[i] || "", customdata: trace.further[i] };
    }

    // Says what is at a place.
    read(at) {
      const { traces, reads_nearest, x } = this.data;
      const read = traces.map((trace, i) => ({ trace, i })).filter(({ trace, i }) => this.shown[i] && trace.hover !== null);
      const points = read.filter(({ trace }) => !trace.values);
      const found = points.map(({ trace }) => ({ trace, near: this.nearest(trace, at, !reads_nearest) })).filter(({ near }) => near);
      found.sort((a, b) => a.near.distance - b.near.distance);
      if (found.length && !reads_nearest) {
        const [{ trace, near }] = found;
        const title = x.names.length ? x.names[Math.round(trace.x[near.i])] : formatted(trace.x[near.i], x.format);
        const together = found.filter((one) => Math.abs(one.near.at[0] - near.at[0]) < 8 || x.names.length);
        together.sort((a, b) => traces.indexOf(a.trace) - traces.indexOf(b.trace));
        return this.say(near.at[0], at[1], [title], together.map((one) => [one.trace, this.said(one.trace, this.values(one.trace, one.near.i)).join(" ")]), true);
      }
      if (found.length) {
        const [{ trace, near }] = found;
        const isNamed = !trace.hover.includes("<extra></extra>") && trace.name;
        const lines = this.said(trace, this.values(trace, near.i));
        return this.say(...near.at, lines, isNamed ? [[trace, ""]] : [], false);
      }
      for (const { trace } of read.filter(({ trace: { values } }) => values)) {
        const cell = this.cell(trace, this.at, at);
        if (cell) return this.say(...at, this.said(trace, cell), [], false);
      }
      this.hide();
    }

    say(x, y, lines, entries, isAcross) {
      const texts = lines.map((line) => element("div", "", line));
      const listed = entries.map(([trace, said]) => {
        const line = element("div", "", said ? `${trace.name}: ${said}` : trace.name);
        const sign = element("i", "", "");
        sign.style.background = trace.colour;
        line.prepend(sign);
        return line;
      });
      this.tip.replaceChildren(...texts, ...listed);
      this.tip.hidden = false;
      const scale = this.svg.getBoundingClientRect().width / this.width;
      const { offsetWidth: width, offsetHeight: height } = this.tip;
      const isLeft = x * scale + width + 16 > this.node.clientWidth;
      this.tip.style.left = `${Math.max(0, isLeft ? x * scale - width - 12 : x * scale + 12)}px`;
      this.tip.style.top = `${Math.min(Math.max(0, y * scale - height / 2), Math.max(0, this.node.clientHeight - height))}px`;
      this.cursor = this.cursor || this.svg.appendChild(svgElement("path", { class: "cursor" }));
      this.cursor.setAttribute("d", isAcross ? `M${x} ${this.frame[1]}V${this.frame[3]}` : entries.length ? `M${x - 4} ${y}a4 4 0 1 0 8 0a4 4 0 1 0 -8 0` : "");
    }

    hide() {
      this.tip.hidden = true;
      if (this.cursor) this.cursor.setAttribute("d", "");
    }

    // What a slider does: from one state to another, or both gears turned and their points of contact moved.
    move(at) {
      const { control } = this.data;
      this.at = at;
      this.hide();
      const said = control.kind === "steps" ? this.state(control, at) : this.mesh(control, at);
      this.slider.querySelector("output").textContent = said;
    }

    state({ steps }, at) {
      const { label, change } = steps[at];
      if (change.shown) change.shown.forEach((isShown, i) => this.show([i], isShown));
      for (const picture of this.svg.querySelectorAll("image[data-state]")) {
        picture.setAttribute("display", Number(picture.dataset.state) === at ? "inline" : "none");
      }
      return label;
    }

    mesh(control, at) {
      const { x, y, frame } = this.data;
      const drawn = ([px, py]) => [
        frame[0] + ((px - x.range[0]) / (x.range[1] - x.range[0])) * (frame[2] - frame[0]),
        frame[3] + ((py - y.range[0]) / (y.range[1] - y.range[0])) * (frame[1] - frame[3]),
      ];
      for (const { trace, centre_mm, radians_per_mm } of control.bodies) {
        const angle = (((at - control.drawn_at_mm) * radians_per_mm * 180) / Math.PI) % 360;
        // On the drawing y goes downwards.
        this.turned.set(trace, `rotate(${-angle},${drawn(centre_mm)})`);
      }
      const [first, last] = control.path_mm;
      const pitch = control.base_pitch_mm;
      const inContact = [];
      for (let place = at - Math.floor((at - first) / pitch) * pitch; place <= last; place += pitch) inContact.push(place);
      const group = this.groups[control.contacts];
      const [sign] = group.children;
      const signs = inContact.map((place) => {
        const one = sign.cloneNode(true);
        one.drawn = drawn([0, 1].map((axis) => control.origin_mm[axis] + place * control.direction[axis]));
        return one;
      });
      if (signs.length) group.replaceChildren(...signs);
      this.place();
      const share = (place) => {
        const { position_mm: places, load_share: shares } = control;
        const after = places.findIndex((other) => other >= place);
        if (after < 1) return after === 0 ? shares[0] : shares[shares.length - 1];
        const part = (place - places[after - 1]) / (places[after] - places[after - 1] || 1);
        return shares[after - 1] + part * (shares[after] - shares[after - 1]);
      };
      return `${at.toFixed(2)} mm; load shares ${inContact.map((place) => share(place).toFixed(2)).join(", ")}`;
    }
  }

  const PLAY_STEPS = 900; // ms from one snapshot to the next
  const PLAY_MESH = 3000; // ms for a base pitch

  // Joins a plot and the slider below it.
  function slide(plot) {
    const { control } = plot.data;
    const slider = (plot.slider = plot.node.parentNode.querySelector(".slider"));
    const [button, input] = [slider.querySelector("button"), slider.querySelector("input")];
    const isMesh = control.kind === "mesh";
    const [least, most] = isMesh ? control.path_mm : [0, control.steps.length - 1];
    const first = isMesh ? control.drawn_at_mm : most;
    Object.assign(input, { min: least, max: most, step: isMesh ? (most - least) / 400 : 1, value: first });
    const move = (at) => {
      input.value = at;
      plot.move(at);
    };
    let playing = null;
    const stop = () => {
      cancelAnimationFrame(playing);
      playing = null;
      button.textContent = "▶";
      button.setAttribute("aria-label", "play");
    };
    const play = () => {
      let [before, at] = [performance.now(), plot.at ?? first];
      if (!isMesh && at >= most) move((at = least));
      const next = (now) => {
        const passed = now - before;
        if (isMesh) {
          at += (passed / PLAY_MESH) * control.base_pitch_mm;
          // A base pitch later the mesh repeats itself.
          if (at > most) at -= Math.max(1, Math.floor((at - least) / control.base_pitch_mm)) * control.base_pitch_mm;
          before = now;
          move(at);
        } else if (passed >= PLAY_STEPS) {
          at += 1;
          before = now;
          move(at);
          if (at >= most) return stop();
        }
        if (playing !== null) playing = requestAnimationFrame(next);
      };
      button.textContent = "❚❚";
      button.setAttribute("aria-label", "pause");
      playing = requestAnimationFrame(next);
    };
    button.addEventListener("click", () => (playing === null ? play() : stop()));
    input.addEventListener("input", () => {
      stop();
      plot.move(Number(input.value));
    });
    slider.hidden = false;
    plot.move(first);
  }

  // A table wider than its room becomes a list of its rows, each cell with the name of its column.
  const stacked = new ResizeObserver((entries) => {
    for (const { target: room, contentRect: { width } } of entries) {
      if (width === 0 || room.dataset.width === String(width)) continue;
      room.dataset.width = width;
      const table = room.querySelector("table");
      table.classList.remove("stacked");
      table.classList.toggle("stacked", room.scrollWidth > room.clientWidth + 1);
    }
  });
  for (const room of document.querySelectorAll(".scroll")) {
    const columns = [...room.querySelectorAll("thead tr > *")].map((column) => column.textContent);
    for (const row of room.querySelectorAll("tbody tr")) [...row.cells].forEach((cell, i) => (cell.dataset.column = columns[i] || ""));
    stacked.observe(room);
  }

  // Opens what a link leads to, and all of it.
  const folds = [...document.querySelectorAll("details.fold")];
  const lead = () => {
    const at = location.hash && document.getElementById(decodeURIComponent(location.hash.slice(1)));
    const fold = at && at.closest("details");
    if (!fold || fold.open) return;
    fold.open = true;
    at.scrollIntoView();
  };
  addEventListener("hashchange", lead);
  lead();
  if (folds.length) {
    const line = element("p", "folds", "");
    const button = line.appendChild(element("button", "", ""));
    button.type = "button";
    const name = () => (button.textContent = folds.every((fold) => fold.open) ? "Close all" : "Open all");
    button.addEventListener("click", () => {
      const isOpen = folds.every((fold) => fold.open);
      for (const fold of folds) fold.open = !isOpen;
    });
    for (const fold of folds) fold.addEventListener("toggle", name);
    name();
    folds[0].before(line);
  }

  const plots = [...document.querySelectorAll(".plot")].map((node) => (node.querySelector("canvas") ? new SurfacePlot(node) : new Plot(node)));

  const printing = () => "printing" in root.dataset;
  function fit() {
    for (const plot of plots) {
      const printed = plot.node.closest(".first") ? PRINT_WIDTH_BESIDE : PRINT_WIDTH;
      const width = printing() ? printed : plot.node.clientWidth;
      if (width > 0 && width !== plot.width) plot.fit(width);
    }
  }
  fit();
  for (const plot of plots) if (plot.data.control) slide(plot);
  const room = new ResizeObserver(() => printing() || fit());
  for (const { node } of plots) room.observe(node);
  const surfaces = plots.filter((plot) => plot instanceof SurfacePlot);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => surfaces.forEach((plot) => plot.draw()));
  addEventListener("beforeprint", () => {
    root.dataset.printing = "";
    fit();
    surfaces.forEach((plot) => plot.draw());
  });
  addEventListener("afterprint", () => {
    delete root.dataset.printing;
    fit();
    surfaces.forEach((plot) => plot.draw());
  });
})();
