// Bundles src/main.js with three.js into the page's program, three's licence at its head.
// node build.mjs [FILE]; by default the file that the Python package holds.
import { build } from "esbuild";
import { readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const licence = readFileSync(join(here, "node_modules/three/LICENSE"), "utf8").trim();
const { version } = JSON.parse(readFileSync(join(here, "node_modules/three/package.json"), "utf8"));

await build({
  absWorkingDir: here,
  entryPoints: ["src/main.js"],
  outfile: process.argv[2] ?? "../conformal_uv/page/assets/page.js",
  bundle: true,
  minify: true,
  format: "iife",
  target: "es2022",
  charset: "utf8",
  legalComments: "none",
  banner: {
    js: `/*! conformal_uv's page (GPL-3.0-or-later; sources in web/) with three.js ${version}:\n\n${licence}\n*/`,
  },
});
