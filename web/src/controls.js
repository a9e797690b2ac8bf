// The page's own elements: what is coloured, the checker's size, the legend, what is told of a point.
import { gradient } from "./colours.js";
import { MODES } from "./shaders.js";

const one = (id) => document.getElementById(id);

/** Colour of the CSS variable, as three numbers from 0 to 1. */
export function colour_of(name) {
  const probe = document.createElement("canvas").getContext("2d");
  probe.fillStyle = getComputedStyle(document.documentElement).getPropertyValue(name).trim() || "#888";
  probe.fillRect(0, 0, 1, 1);
  return [...probe.getImageData(0, 0, 1, 1).data.slice(0, 3)].map((x) => x / 255);
}

/** Call `to` = { mode(k), squares(count), reset(), turning(on) } when something is chosen. */
export function connect(about, to) {
  const radios = [...document.querySelectorAll("input[name=mode]")];
  const choose = () => {
    const mode = MODES.indexOf(radios.find((radio) => radio.checked)?.value ?? "checker");
    legend(about, MODES[mode]);
    one("squares-row").hidden = mode !== 0;
    to.mode(mode);
  };
  radios.forEach((radio) => radio.addEventListener("change", choose));
  one("squares").addEventListener("input", (event) => to.squares(Number(event.target.value)));
  one("reset").addEventListener("click", to.reset);
  const turning = one("turning");
  one("turning-row").hidden = about.shape !== "sphere";
  turning.addEventListener("change", () => to.turning(turning.checked));
  choose();
}

function legend(about, mode) {
  const shown = mode !== "checker";
  one("legend").hidden = !shown;
  if (!shown) return;
  const limit = about[mode].shown;
  one("ramp").style.background = gradient(mode);
  const ends = mode === "angle" ? ["0\u00b0", `${digits(limit)}\u00b0`] : [times(-limit), times(limit)];
  one("low").textContent = ends[0];
  one("high").textContent = `${ends[1]} and more`;
  one("legend-name").textContent = mode === "angle" ? "angle error" : "area, of the middle one";
}

/** The table of numbers. */
export function tell_facts(about) {
  const rows = [
    ["vertices", about.vertices.toLocaleString("en")],
    ["triangles", about.triangles.toLocaleString("en")],
    ["mean angle error", `${digits(about.angle.mean)}\u00b0`],
    ["largest", `${digits(about.angle.max)}\u00b0`],
  ];
  if (about.flipped) rows.push(["flipped triangles", about.flipped.toLocaleString("en")]);
  one("facts").replaceChildren(
    ...rows.map(([name, value]) => {
      const row = document.createElement("div");
      row.append(element("dt", name), element("dd", value));
      return row;
    }),
  );
}

/** What is known of the point under the pointer; null where there is none. */
export function tell_point(found) {
  one("point").textContent = found
    ? `angle error ${digits(found.angle)}\u00b0, area ${times(found.area)}`
    : one("point").dataset.empty;
}

export function fail(text) {
  const problem = one("problem");
  problem.textContent = text;
  problem.hidden = false;
}

function element(name, text) {
  const made = document.createElement(name);
  made.textContent = text;
  return made;
}

const digits = (x) => Number(x.toPrecision(3)).toString();
const times = (doublings) => `\u00d7 ${digits(2 ** doublings)}`;
