// Draws the plots in the colours of the style sheet: again when those change, when the room for a plot changes, and
// when the page is printed. The script that draws them stands in the page compressed.
(async () => {
  "use strict";
  const PRINT_WIDTH = 670; // px: an A4 page less its margins
  const NARROW = 480; // px: below this a plot is that of a phone
  const FARTHER = [[480, 2.2], [900, 1.25]]; // how much farther away a scene in space is looked at below a width in px
  const PRINTED = 0.84; // height of a plot of half the width, so that two of them stand on a page
  const BUTTONS = 26; // px: height of a plot's buttons, which show all the time where there is no mouse to hover
  const root = document.documentElement;
  const touch = matchMedia("(pointer: coarse)").matches;
  const buttonsShown = matchMedia("(hover: none)").matches;
  const plots = [...document.querySelectorAll(".plot")].map((node) => ({
    node,
    source: JSON.parse(document.getElementById(node.id + "-data").textContent),
    width: 0,
    at: null, // value of its slider, where it has been moved
  }));

  // Printing itself changes the preferred colours and the room for the plots: whatever redraws must ask.
  const printing = () => "printing" in root.dataset;

  // A function that turns a colour token into the colour in force.
  function palette() {
    const style = getComputedStyle(root);
    const value = (name) => style.getPropertyValue(name).trim();
    const channels = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));
    return (text) => {
      const plain = /^var\((--[\w-]+)\)$/.exec(text);
      if (plain) return value(plain[1]);
      const mix = /^mix\((--[\w-]+),(--[\w-]+),([\d.]+)\)$/.exec(text);
      if (!mix) return text;
      const [from, to] = [channels(value(mix[1])), channels(value(mix[2]))];
      return `rgb(${from.map((c, i) => Math.round(c + (to[i] - c) * mix[3])).join(",")})`;
    };
  }

  // A copy of a plot's description with its colours resolved; the numbers are shared.
  function coloured(item, colour) {
    if (typeof item === "string") return colour(item);
    if (Array.isArray(item)) return typeof item[0] === "number" ? item : item.map((x) => coloured(x, colour));
    if (item === null || typeof item !== "object") return item;
    return Object.fromEntries(Object.entries(item).map(([key, x]) => [key, coloured(x, colour)]));
  }

  function draw(plot, colour) {
    const { data, layout, config } = coloured(plot.source, colour);
    plot.width = plot.node.clientWidth;
    layout.width = printing() ? PRINT_WIDTH : plot.width;
    layout.autosize = false;
    Object.assign(layout.legend, { yref: "container", y: 0, yanchor: "bottom" }); // below the axis title, always
    layout.uirevision = "kept"; // the reader's zoom outlasts a change of theme
    if (touch) layout.dragmode = false; // a finger scrolls the page
    if (printing() && !plot.node.closest(".wide")) layout.height *= PRINTED;
    const farther = FARTHER.find(([below]) => layout.width < below);
    if (layout.scene && farther) for (const axis of "xyz") layout.scene.camera.eye[axis] *= farther[1];
    if (layout.width < NARROW) {
      layout.legend.font.size = 11;
      if (layout.scene) for (const axis of "xyz") layout.scene[axis + "axis"].nticks = 4;
      layout.height = Math.min(layout.height, layout.width + (plot.node.closest(".wide") ? 140 : 40));
    }
    if (buttonsShown && !printing()) {
      layout.margin.t += BUTTONS;
      layout.height += BUTTONS;
    }
    Plotly.react(plot.node, data, layout, config);
    if (plot.at !== null && !printing()) show(plot, plot.at);
  }

  // What a slider does to its plot: from one state to another, or both gears turned and their points of contact moved.
  function show(plot, at) {
    const { control } = plot.source;
    plot.at = at;
    const [said, update, traces] = control.kind === "steps" ? state(control, at) : mesh(plot.source.data, control, at);
    plot.slider.querySelector("output").textContent = said;
    return Plotly.restyle(plot.node, update, traces);
  }

  function state({ steps }, at) {
    const { label, change } = steps[at];
    return change.shown ? [label, { visible: change.shown }, change.shown.map((_, i) => i)] : [label, { z: [change.cells] }, [0]];
  }

  function mesh(data, control, at) {
    const turned = control.bodies.map(({ trace, centre_mm: [cx, cy], radians_per_mm }) => {
      const angle = (at - control.drawn_at_mm) * radians_per_mm;
      const [sin, cos] = [Math.sin(angle), Math.cos(angle)];
      const { x, y } = data[trace];
      return [x.map((px, i) => cx + cos * (px - cx) - sin * (y[i] - cy)), y.map((py, i) => cy + sin * (x[i] - cx) + cos * (py - cy))];
    });
    const [first, last] = control.path_mm;
    const pitch = control.base_pitch_mm;
    const inContact = [];
    for (let place = at - Math.floor((at - first) / pitch) * pitch; place <= last; place += pitch) inContact.push(place);
    const share = (place) => {
      const { position_mm: places, load_share: shares } = control;
      const after = places.findIndex((other) => other >= place);
      if (after < 1) return after === 0 ? shares[0] : shares[shares.length - 1];
      const part = (place - places[after - 1]) / (places[after] - places[after - 1] || 1);
      return shares[after - 1] + part * (shares[after] - shares[after - 1]);
    };
    const shares = inContact.map(share);
    const along = (axis) => inContact.map((place) => control.origin_mm[axis] + place * control.direction[axis]);
    const said = `${at.toFixed(2)} mm; load shares ${shares.map((one) => one.toFixed(2)).join(", ")}`;
    return [
      said,
      { x: [...turned.map(([x]) => x), along(0)], y: [...turned.map(([, y]) => y), along(1)] },
      [...control.bodies.map(({ trace }) => trace), control.contacts],
    ];
  }

  const PLAY_STEPS = 900; // ms from one snapshot to the next
  const PLAY_MESH = 3000; // ms for a base pitch

  // Joins a plot and the slider below it.
  function slide(plot) {
    const { control } = plot.source;
    const slider = (plot.slider = plot.node.parentNode.querySelector(".slider"));
    const [button, input] = [slider.querySelector("button"), slider.querySelector("input")];
    const isMesh = control.kind === "mesh";
    const [least, most] = isMesh ? control.path_mm : [0, control.steps.length - 1];
    const first = isMesh ? control.drawn_at_mm : most;
    Object.assign(input, { min: least, max: most, step: isMesh ? (most - least) / 400 : 1, value: first });
    const move = (at) => {
      input.value = at;
      return show(plot, at);
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
      const next = async (now) => {
        const passed = now - before;
        if (isMesh) {
          at += (passed / PLAY_MESH) * control.base_pitch_mm;
          // A base pitch later the mesh repeats itself.
          if (at > most) at -= Math.max(1, Math.floor((at - least) / control.base_pitch_mm)) * control.base_pitch_mm;
          before = now;
          await move(at);
        } else if (passed >= PLAY_STEPS) {
          at += 1;
          before = now;
          await move(at);
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
      show(plot, Number(input.value));
    });
    slider.hidden = false;
    const [said] = isMesh ? mesh(plot.source.data, control, first) : state(control, most);
    slider.querySelector("output").textContent = said;
  }

  const hasRoom = ({ node }) => node.clientWidth > 0 && !node.closest("details:not([open])");

  function drawAll() {
    const colour = palette();
    for (const plot of plots) {
      if (hasRoom(plot)) draw(plot, colour);
      else plot.width = 0; // to be drawn as soon as there is room
    }
  }

  function drawWhatHasOtherRoom() {
    if (printing()) return;
    for (const plot of plots) if (hasRoom(plot) && plot.node.clientWidth !== plot.width) draw(plot, palette());
  }

  async function unpack(base64) {
    const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
    return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).text();
  }

  // A frame whose document is open: the page counts as loaded, and whoever prints it unseen waits, until it is closed.
  const frame = document.createElement("iframe");
  frame.hidden = true;
  document.body.append(frame);
  frame.contentDocument.open();
  const loaded = () => {
    frame.contentDocument.close();
    frame.remove();
  };

  try {
    const script = document.createElement("script");
    script.textContent = await unpack(document.getElementById("plot-script").textContent);
    document.head.append(script);
  } catch {
    for (const message of document.querySelectorAll(".not-drawn")) message.hidden = false;
    return loaded();
  }
  for (const plot of plots) if (plot.source.control) slide(plot);
  drawAll();
  loaded();
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", drawAll);
  const room = new ResizeObserver(drawWhatHasOtherRoom);
  for (const { node } of plots) room.observe(node);
  document.addEventListener("toggle", drawWhatHasOtherRoom, true);
  addEventListener("beforeprint", () => {
    root.dataset.printing = "";
    drawAll();
  });
  addEventListener("afterprint", () => {
    delete root.dataset.printing;
    drawAll();
  });
})();
