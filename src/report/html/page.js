// Draws the plots in the colours of the style sheet, again when those change and when the page is printed.
(() => {
  "use strict";
  const PRINT_WIDTH = 670; // px: an A4 page less its margins
  const NARROW = 480; // px: below this a plot is that of a phone
  const root = document.documentElement;
  const touch = matchMedia("(pointer: coarse)").matches;
  const plots = [...document.querySelectorAll(".plot")].map((node) => ({
    node,
    source: JSON.parse(document.getElementById(node.id + "-data").textContent),
  }));

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

  function draw({ node, source }, colour, width) {
    const { data, layout, config } = coloured(source, colour);
    layout.uirevision = "kept"; // the reader's zoom outlasts a change of theme
    if (width) Object.assign(layout, { width, autosize: false });
    else if (node.clientWidth < NARROW) {
      layout.legend.font.size = 11;
      layout.margin.l = 44;
      layout.height = Math.min(layout.height, node.clientWidth + 60);
    }
    if (touch) layout.dragmode = false; // a finger scrolls the page
    // The legend stands clear of the axis title whatever the height.
    layout.legend.y = -58 / (layout.height - layout.margin.t - layout.margin.b);
    return Plotly.react(node, data, layout, config);
  }

  function drawAll(width) {
    const colour = palette();
    for (const plot of plots) draw(plot, colour, width);
  }

  drawAll();
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => drawAll());
  addEventListener("beforeprint", () => {
    root.dataset.printing = "";
    drawAll(PRINT_WIDTH);
  });
  addEventListener("afterprint", () => {
    delete root.dataset.printing;
    drawAll();
  });
})();
