// Numbers of plots: at axes and as they are read at a point.
const minus = (text) => text.replace(/-/g, "−");

// Numbers in the formats of d3 that charts use, such as ".3f", ".4~g", ".3~%".
function formatted(value, format) {
  if (value === null || value === undefined) return "–";
  const [, digits, trim, kind] = /^\.(\d+)(~?)([fge%])$/.exec(format || ".6~g");
  let text =
    kind === "f" ? value.toFixed(digits)
    : kind === "%" ? (100 * value).toFixed(digits)
    : kind === "e" ? value.toExponential(digits)
    : value.toPrecision(Math.max(1, digits));
  if (trim) text = text.replace(/(\.\d*?)0+(e|$)/, "$1$2").replace(/\.(e|$)/, "$1");
  return minus(text) + (kind === "%" ? "%" : "");
}

const superscript = (exponent) => String(exponent).replace(/./g, (digit) => (digit === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[digit]));

function plain(value) {
  const size = Math.abs(value);
  if (value === 0 || (size >= 1e-3 && size < 1e6)) return minus(String(value));
  const [mantissa, exponent] = value.toExponential().split("e");
  return minus(`${mantissa}·10${superscript(Number(exponent))}`);
}

// Ticks of an axis within its range, as `figure/axis.rs` has them: places in coordinates, with their words.
function ticks(axis, [from, to], length) {
  const [low, high] = [Math.min(from, to), Math.max(from, to)];
  const range = [low, high];
  const inside = ([place]) => place >= low - 1e-9 * (high - low) && place <= high + 1e-9 * (high - low);
  const coordinate = (value) => (axis.is_logarithmic ? Math.log10(value) : value);
  if (axis.names.length) return axis.names.map((name, i) => [i, name]).filter(inside);
  if (axis.ticks.length) return axis.ticks.map(([value, word]) => [coordinate(value), word]).filter(inside);
  const most = Math.max(1, length / axis.spacing_px);
  const every = (step, word, [low, high] = range) => {
    const found = [];
    // Beyond 2⁵² whole numbers no longer follow one another.
    if (!(step > 0) || Math.max(Math.abs(low), Math.abs(high)) / step > 2 ** 52) return found;
    for (let i = Math.ceil(low / step - 1e-9); i <= Math.floor(high / step + 1e-9); i++) found.push([i * step, word(i * step)]);
    return found;
  };
  if (axis.is_logarithmic && high - low >= 2.5) {
    return every(Math.max(1, Math.ceil((high - low) / most)), (exponent) => `10${superscript(exponent)}`);
  }
  if (axis.is_logarithmic && high - low >= 0.7) {
    const all = every(1, (exponent) => exponent).concat([[Math.floor(low), Math.floor(low)]]);
    const values = all.flatMap(([exponent]) => [1, 2, 5].map((factor) => Number((factor * 10 ** exponent).toPrecision(3))));
    return [...new Set(values)].map((value) => [Math.log10(value), plain(value)]).filter(inside);
  }
  const ends = axis.is_logarithmic ? range.map((exponent) => 10 ** exponent) : range;
  const least = (ends[1] - ends[0]) / most;
  const power = 10 ** Math.floor(Math.log10(least));
  const step = [1, 2, 5, 10].map((factor) => factor * power).find((one) => one >= least * (1 - 1e-9)) || 10 * power;
  const order = (value) => Math.floor(Math.log10(Math.abs(value)) + 1e-9);
  const digits = (value) => Math.min(15, Math.max(1, order(value) - order(step) + 1));
  const word =
    step < 1e-4 || step >= 1e6
      ? (value) => plain(value === 0 ? 0 : Number(value.toPrecision(digits(value))))
      : (value) => minus(value.toFixed(Math.max(0, -order(step))));
  return every(step, word, ends).map(([value, text]) => [coordinate(value), text]).filter(inside);
}
