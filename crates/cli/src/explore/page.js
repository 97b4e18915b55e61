// The page of `gearwear explore`: sliders, their answers, variants pinned beside each other.
'use strict';

const byId = (id) => document.getElementById(id);
const GROUPS = [
  ['Tip relief', (name) => name.includes('.tip_relief.')],
  ['Operation and wear', (name) => name.startsWith('operation.') || name.startsWith('wear.')],
  ['Teeth', (name) => name.endsWith('.profile_shift') || name.endsWith('.helix_angle_deg')],
  ['Other modifications', () => true],
];
const LETTERS = ['A', 'B', 'C', 'D'];
// Time without a change after which finite elements are asked, ms.
const REST = 150;

let session = null;
let fast = null, elements = null;        // newest answers, each with the setting it belongs to
let pinned = [];                         // { letter, setting, fast, elements }
let asking = false, asked = null;        // whether the fast model is being asked; when it was to be asked again
let compared = false;                    // whether the finite elements of the scene as opened have been compared
let resting = 0;                         // timer of the rest
let generation = 0;                      // number of the newest setting
const lags = [];                         // from each change to its curves, ms

async function post(name, question) {
  const options = { method: 'POST', headers: { 'Content-Type': 'application/json' }, body: JSON.stringify(question) };
  let response;
  try {
    response = await fetch(name, options);
  } catch {
    // A connection that the server closed while it was idle.
    response = await fetch(name, options);
  }
  if (response.status === 204) return null;   // a newer question took its place
  const kind = response.headers.get('Content-Type') || '';
  const told = kind.startsWith('application/json') ? await response.json() : { message: await response.text() };
  if (!response.ok) throw new Error(told.message);
  return told;
}

function say(text) { byId('state').textContent = text; }

function refuse(text) {
  const place = byId('refusal');
  place.hidden = !text;
  // What stays belongs to an older setting.
  byId('charts').classList.toggle('stale', Boolean(text));
  byId('figures').classList.toggle('stale', Boolean(text));
  place.textContent = text || '';
}

// Values of the sliders that are not where the scene has them.
function setting() {
  const moved = {};
  for (const slider of session.sliders) if (slider.index !== slider.at) moved[slider.name] = slider.values[slider.index];
  return moved;
}

const same = (a, b) => JSON.stringify(a) === JSON.stringify(b);

function valueText(slider, index) {
  const value = slider.values[index];
  return `${Math.abs(value) !== 0 && (Math.abs(value) < 1e-3 || Math.abs(value) >= 1e6) ? value.toExponential() : value}${slider.unit ? ` ${slider.unit}` : ''}`;
}

function showSlider(slider) {
  slider.output.textContent = valueText(slider, slider.index);
  slider.input.value = slider.index;
  slider.input.setAttribute('aria-valuetext', slider.output.textContent);
  slider.row.classList.toggle('moved', slider.index !== slider.at);
}

function buildSliders() {
  const form = byId('sliders');
  const left = new Set(session.sliders);
  for (const [title, belongs] of GROUPS) {
    const own = [...left].filter((slider) => belongs(slider.name));
    if (!own.length) continue;
    const group = document.createElement('fieldset');
    const legend = document.createElement('legend');
    legend.textContent = title;
    group.append(legend);
    for (const slider of own) {
      left.delete(slider);
      slider.index = slider.at;
      slider.row = document.createElement('div');
      slider.row.className = 'slider';
      const label = document.createElement('label');
      const id = `slider-${session.sliders.indexOf(slider)}`;
      label.htmlFor = id;
      label.append(slider.label);
      slider.output = document.createElement('output');
      label.append(slider.output);
      slider.input = Object.assign(document.createElement('input'), { type: 'range', id, min: 0, max: slider.values.length - 1, step: 1 });
      slider.input.addEventListener('input', () => {
        slider.index = Number(slider.input.value);
        showSlider(slider);
        changed();
      });
      slider.row.append(label, slider.input);
      if (slider.note) {
        const note = document.createElement('small');
        note.textContent = slider.note;
        slider.row.append(note);
      }
      showSlider(slider);
      group.append(slider.row);
    }
    form.append(group);
  }
}

function changed() {
  generation += 1;
  clearTimeout(resting);
  asked = performance.now();
  askFast();
}

// Asks the fast model for the newest setting, one question at a time.
async function askFast() {
  if (asking) return;
  asking = true;
  while (asked !== null) {
    const since = asked, of = setting(), number = generation;
    asked = null;
    try {
      const answer = await post('answer', { setting: of, model: 'fast' });
      if (answer) {
        fast = { setting: of, answer };
        refuse('');
        show();
        lags.push(performance.now() - since);
        document.documentElement.dataset.answered = String(number);
      }
    } catch (error) {
      refuse(error.message);
      document.documentElement.dataset.answered = String(number);
    }
  }
  asking = false;
  resting = setTimeout(askElements, REST);
}

async function askElements() {
  const of = setting(), number = generation;
  say('Finite elements…');
  const start = performance.now();
  try {
    const answer = await post('answer', { setting: of, model: 'finite-elements' });
    if (!answer || number !== generation) return;
    elements = { setting: of, answer, seconds: (performance.now() - start) / 1000 };
    keep(of, elements);
    document.documentElement.dataset.elements = String(number);
    document.documentElement.dataset.seconds = elements.seconds.toFixed(3);
    say('');
    show();
    if (session.compared_once && !compared) {
      say('Comparing the finite elements of the scene as opened with others…');
      // Interrupted by the next change, and asked again after the next answer.
      const band = await post('band', {});
      if (!band) return;
      compared = true;
      say('');
      for (const figure of answer.figures) figure.difference = band[figure.name] ?? null;
      show();
    }
  } catch (error) {
    if (number !== generation) return;
    say('');
    refuse(error.message);
  }
}

// Gives a pinned variant the answer that came after it was pinned.
function keep(of, answer) {
  for (const pin of pinned) if (!pin.elements && same(pin.setting, of)) pin.elements = answer;
}

const current = () => (elements && fast && same(elements.setting, fast.setting) ? elements : null);
const best = (pin) => (pin.elements || pin.fast).answer;

function cell(kind, text, className) {
  const made = document.createElement(kind);
  if (text !== undefined) made.textContent = text;
  if (className) made.className = className;
  return made;
}

function showFigures() {
  const head = cell('tr');
  head.append(cell('th', ''), cell('th', 'Fast model'), cell('th', 'Finite elements'));
  for (const pin of pinned) {
    const th = cell('th', undefined, `pin-${pin.slot}`);
    const back = cell('button', pin.letter);
    back.type = 'button';
    back.setAttribute('aria-label', `Back to variant ${pin.letter}`);
    back.addEventListener('click', () => restore(pin.setting));
    const remove = cell('button', '×');
    remove.type = 'button';
    remove.setAttribute('aria-label', `Remove variant ${pin.letter}`);
    remove.addEventListener('click', () => { pinned = pinned.filter((other) => other !== pin); show(); });
    th.append(back, ' ', remove);
    head.append(th);
  }
  const rows = fast.answer.figures.map((figure, i) => {
    const row = cell('tr');
    row.append(cell('th', figure.label + (figure.unit ? `, ${figure.unit}` : '')));
    row.append(cell('td', digits(figure.value, 4), 'now'));
    const of = current();
    const found = of && of.answer.figures[i];
    const answered = cell('td', found ? digits(found.value, 4) : '…', 'fem');
    if (found && found.difference !== null) answered.append(' ', cell('small', `± ${digits(100 * Math.abs(found.difference), 2)} %`));
    row.append(answered);
    for (const pin of pinned) row.append(cell('td', (pin.elements ? '' : '≈ ') + digits(best(pin).figures[i].value, 4), `pin-${pin.slot}`));
    return row;
  });
  const top = cell('thead'), body = cell('tbody');
  top.append(head);
  body.append(...rows);
  byId('figures').replaceChildren(top, body);
  byId('pinned').replaceChildren(...pinned.map((pin) => {
    const said = session.sliders.filter((s) => s.name in pin.setting).map((s) => `${s.label} ${valueText(s, s.values.indexOf(pin.setting[s.name]))}`);
    const from = pin.elements ? 'finite elements' : 'fast model';
    return cell('li', `${pin.letter} (${from}): ${said.join('; ') || 'the scene'}`, `pin-${pin.slot}`);
  }));
  byId('pin').disabled = pinned.length >= LETTERS.length;
}

const maximum = (values) => values.reduce((most, value) => (value > most ? value : most), 0);

// Greatest value of a curve between the start of the active profile and the tip-edge zone.
function mostActive(flank, name) {
  const [from, to] = [Math.min(...flank.zones_mm.slice(0, 2)), Math.max(...flank.zones_mm.slice(0, 2))];
  return maximum(flank[name].filter((_, i) => flank.radius_mm[i] >= from && flank.radius_mm[i] <= to));
}

// Greatest flank pressure, without that of tip edges, which would hide the others.
const flankPressure = (answer) => maximum(answer.figures.filter((figure) => figure.name.endsWith('.flank_pressure_MPa')).map((figure) => figure.value));

function showCharts() {
  const now = fast.answer, of = current();
  const sources = [[now, 'now']];
  if (of) sources.push([of.answer, 'fem']);
  for (const gear of ['pinion', 'wheel']) {
    const flank = now.flanks[gear], [sap, edge, tip] = flank.zones_mm;
    const frame = { x: 'radius, mm', within: [Math.min(sap, tip), Math.max(sap, tip)], zones: [[Math.min(edge, tip), Math.max(edge, tip)]], fromZero: true };
    const curves = (names) => [
      ...sources.flatMap(([answer, kind]) => names.map(([name, faint]) => ({ x: answer.flanks[gear].radius_mm, y: answer.flanks[gear][name], kind: `${kind}${faint}` }))),
      ...pinned.map((pin) => ({ x: best(pin).flanks[gear].radius_mm, y: best(pin).flanks[gear][names[0][0]], kind: `pinned pin-${pin.slot}` })),
    ];
    const shown = [...sources.map(([answer]) => answer), ...pinned.map(best)];
    const mostWear = 1.2 * maximum(shown.map((answer) => mostActive(answer.flanks[gear], 'wear_um')));
    drawChart(byId(`wear-${gear}`), { ...frame, name: `Wear of the ${gear}`, y: 'depth, µm', most: mostWear || 1, series: curves([['wear_um', '']]) });
    drawChart(byId(`pressure-${gear}`), {
      ...frame, name: `Flank pressure, ${gear}`, y: 'MPa; faint: new', most: 1.3 * maximum(shown.map(flankPressure)) || 1,
      series: curves([['pressure_worn_MPa', ''], ['pressure_new_MPa', ' faint']]),
    });
  }
  const cycle = (names) => [
    ...sources.flatMap(([answer, kind]) => names.map(([name, faint]) => ({ x: answer.mesh_cycle.position_mm, y: answer.mesh_cycle[name], kind: `${kind}${faint}` }))),
    ...pinned.map((pin) => ({ x: best(pin).mesh_cycle.position_mm, y: best(pin).mesh_cycle[names[0][0]], kind: `pinned pin-${pin.slot}` })),
  ];
  const along = { x: 'radius of curvature of the pinion, mm' };
  drawChart(byId('transmission'), { ...along, name: 'Transmission error', y: 'µm; faint: new', series: cycle([['transmission_error_worn_um', ''], ['transmission_error_new_um', ' faint']]) });
  drawChart(byId('share'), { ...along, name: 'Load share of a tooth pair', y: 'faint: new', fromZero: true, series: cycle([['load_share_worn', ''], ['load_share_new', ' faint']]) });
  drawPair(byId('drawing'), now.drawing);
}

function show() {
  showFigures();
  showCharts();
  const warnings = (current() || fast).answer.warnings;
  byId('models').querySelector('ul').replaceChildren(...warnings.map((text) => cell('li', text)));
}

function pin() {
  if (!fast || pinned.length >= LETTERS.length) return;
  const slot = LETTERS.findIndex((_, i) => !pinned.some((other) => other.slot === i));
  pinned.push({ slot, letter: LETTERS[slot], setting: fast.setting, fast, elements: current() });
  show();
}

// Sets the sliders as a variant has them.
function restore(to) {
  for (const slider of session.sliders) {
    slider.index = slider.name in to ? slider.values.indexOf(to[slider.name]) : slider.at;
    showSlider(slider);
  }
  changed();
}

async function save(name) {
  try {
    const { files } = await post(name, { setting: setting(), model: byId('model').value });
    for (const file of files) {
      const link = document.createElement('a');
      link.href = URL.createObjectURL(new Blob([file.text], { type: 'text/plain' }));
      link.download = file.name;
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 10000);
    }
    refuse('');
  } catch (error) {
    refuse(error.message);
  }
}

async function begin() {
  const response = await fetch('session');
  if (!response.ok) throw new Error('the program has ended');
  session = await response.json();
  byId('title').textContent = session.title;
  document.title = `${session.title} – gearwear explore`;
  byId('models').querySelector('dl').append(
    cell('dt', 'Fast model'), cell('dd', session.models.fast),
    cell('dt', 'Finite elements'), cell('dd', `${session.models.finite_elements}; ± is the difference to other ones${session.compared_once ? ', of the scene as opened' : ''}`),
  );
  buildSliders();
  byId('sliders').addEventListener('submit', (event) => event.preventDefault());
  byId('pin').addEventListener('click', pin);
  byId('reset').addEventListener('click', () => restore({}));
  byId('save').addEventListener('click', () => save('scene'));
  byId('improve').addEventListener('click', () => save('improve'));
  const open = new EventSource('window');
  open.onerror = () => say('The program has ended; what is shown stays.');
  open.onopen = () => { if (byId('state').textContent.startsWith('The program')) say(''); };
  say('');
  changed();
}

begin().catch((error) => refuse(error.message));
