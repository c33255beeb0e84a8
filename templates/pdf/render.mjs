// Sets certificates as PDF/A-3a with Typst, one after the other, in a process that stays.
// Usage: node render.mjs NODE_MODULES WORKSPACE [FONT_FOLDER...]
//
// Each line of standard input is a request, JSON: {"template": "…/certificate.typ", "further_fonts": true|false}. The
// files of the document are in WORKSPACE: view.json, and certificate.xml if one is attached. {"fonts": "…/certificate.typ"} asks for the fonts of a template and gets
//   {"status": "done", "fonts": [{"family": "…", "style": "…", "from": "…"}]}   from: "" where it is built in
// JSON on standard output:
//   {"status": "done", "memory": bytes}                      WORKSPACE/certificate.pdf is there
//   {"status": "template", "messages": ["…"]}                the template cannot be set
//   {"status": "refused", "messages": ["…"], "texts": ["…"]} what it gives is no PDF/A-3a; texts that no font can show
//   {"status": "failed", "messages": ["…"], "code": "…"}     a file, a defect; the code is that of the system
// The end of standard input ends the process. Then, or when the program that started it has gone, its folder goes as
// well: it holds the customer's data.
import fs from 'node:fs';
import path from 'node:path';
import readline from 'node:readline';
import { createRequire } from 'node:module';
import { Worker } from 'node:worker_threads';

const [modules, workspace, ...fontFolders] = process.argv.slice(2);
const { NodeCompiler } = createRequire(path.join(modules, 'x.js'))('@myriaddreamin/typst-ts-node-compiler');
const main = path.join(workspace, 'certificate.typ');

// The folder that was made for this process, with the workspace in it.
const folder = path.dirname(workspace);
function removeFolder() {
  if (path.basename(folder).startsWith('gumcert-')) fs.rmSync(folder, { recursive: true, force: true });
}

// An interrupt of the terminal reaches this process, too. It ends by the end of its input, and so cleans up; and while
// Typst is at work, which may be for long, another thread sees when the program has gone.
for (const signal of ['SIGINT', 'SIGTERM', 'SIGHUP']) process.on(signal, () => {});
const watch = `
  const { workerData } = require('node:worker_threads');
  const fs = require('node:fs');
  setInterval(() => {
    if (process.ppid === workerData.parent) return;
    if (workerData.folder) fs.rmSync(workerData.folder, { recursive: true, force: true });
    process.kill(process.pid, 'SIGKILL');
  }, 500);`;
new Worker(watch, {
  eval: true,
  workerData: { parent: process.ppid, folder: path.basename(folder).startsWith('gumcert-') ? folder : '' },
}).unref();

// Fonts that a laboratory has put beside its template.
function fontsBeside(template) {
  const folder = path.join(path.dirname(template), 'fonts');
  return fs.existsSync(folder) ? [folder] : [];
}

// The compiler keeps its fonts. Opening further folders takes time, so it is done for the first document that asks.
const compilers = {};
function compilerWith(folders) {
  const fontArgs = folders.length > 0 ? { fontArgs: [{ fontPaths: folders }] } : {};
  return (compilers[folders.join('\n')] ??= NodeCompiler.create({ workspace, ...fontArgs }));
}

// The compiler package has these inside, and tells nobody.
const builtIn = {
  'DejaVu Sans Mono': ['Book', 'Bold', 'Oblique', 'Bold Oblique'],
  'Libertinus Serif': ['Regular', 'Bold', 'Italic', 'Bold Italic', 'Semibold', 'Semibold Italic'],
  'New Computer Modern': ['Regular', 'Bold', 'Italic', 'Bold Italic'],
  'New Computer Modern Math': ['Regular', 'Bold', 'Book'],
};

// Family and style of each font of a file: OpenType, "name" table (16 and 17 where there are more than four styles).
function namesIn(file) {
  const data = fs.readFileSync(file);
  const starts = data.toString('latin1', 0, 4) === 'ttcf'
    ? Array.from({ length: data.readUInt32BE(8) }, (_, i) => data.readUInt32BE(12 + 4 * i)) : [0];
  return starts.map((start) => {
    const names = {};
    for (let i = 0; i < data.readUInt16BE(start + 4); ++i) {
      const entry = start + 12 + 16 * i;
      if (data.toString('latin1', entry, entry + 4) !== 'name') continue;
      const table = data.readUInt32BE(entry + 8);
      const texts = table + data.readUInt16BE(table + 4);
      for (let n = 0; n < data.readUInt16BE(table + 2); ++n) {
        const at = table + 6 + 12 * n;
        // Windows, English: UTF-16 with the higher byte first.
        if (data.readUInt16BE(at) !== 3 || data.readUInt16BE(at + 4) !== 0x409) continue;
        const from = texts + data.readUInt16BE(at + 10);
        const bytes = Buffer.from(data.subarray(from, from + data.readUInt16BE(at + 8)));
        names[data.readUInt16BE(at + 6)] = bytes.swap16().toString('utf16le');
      }
    }
    return { family: names[16] ?? names[1], style: names[17] ?? names[2] };
  });
}

function fontsOf(template) {
  const fonts = Object.entries(builtIn).flatMap(([family, styles]) => styles.map((style) => ({ family, style, from: '' })));
  for (const folder of [...fontsBeside(template), ...fontFolders]) {
    for (const name of fs.readdirSync(folder, { recursive: true }).map(String).sort()) {
      if (!/\.(otf|ttf|otc|ttc)$/i.test(name)) continue;
      try {
        for (const { family, style } of namesIn(path.join(folder, name))) {
          if (family) fonts.push({ family, style: style ?? '', from: folder });
        }
      } catch {
        continue;  // no font that anything could use
      }
    }
  }
  return { status: 'done', fonts };
}

// The only files that the template can see are those of the workspace.
function copyTemplates(template) {
  const folder = path.dirname(template);
  for (const name of fs.readdirSync(folder)) {
    if (/\.(typ|png|jpe?g|svg)$/.test(name)) fs.copyFileSync(path.join(folder, name), path.join(workspace, name));
  }
  if (path.basename(template) !== 'certificate.typ') fs.copyFileSync(template, main);
}

// Symbol and logo come as Base64 in the view; Typst reads files, and would be slow to decode them.
function writePictures() {
  const view = JSON.parse(fs.readFileSync(path.join(workspace, 'view.json'), 'utf8'));
  for (const page of [view, ...(view.identity ?? [])]) {
    for (const picture of [...(page.symbol ?? []), ...(page.logo ?? [])]) {
      if (!/^(symbol|laboratory-logo)\.(png|jpg|svg)$/.test(picture.file)) throw new Error(`not a name of a picture: ${picture.file}`);
      fs.writeFileSync(path.join(workspace, picture.file), Buffer.from(picture.base64, 'base64'));
    }
  }
}

// "certificate.typ:12:5: unclosed delimiter"; the place where Typst knows it.
function textOf({ message, path: file, range }) {
  const place = range ? `:${range.start.line + 1}:${range.start.character + 1}` : '';
  return (file ? `${path.basename(file)}${place}: ` : '') + message;
}

function messagesOf(error) {
  const quoted = [...String(error.message).matchAll(/message: "((?:[^"\\]|\\.)*)"/g)];
  return quoted.length > 0 ? quoted.map((m) => m[1].replaceAll('\\"', '"')) : [String(error.message)];
}

function setDocument({ template, further_fonts: furtherFonts }) {
  copyTemplates(template);
  writePictures();
  const compiler = compilerWith([...fontsBeside(template), ...(furtherFonts === true ? fontFolders : [])]);
  const texts = (error) => (error ? compiler.fetchDiagnostics(error).map(textOf) : []);
  // The files have the same names for every document: what was read before is forgotten.
  const compiled = compiler.compile({ mainFilePath: main, resetRead: true });
  if (!compiled.result) return { status: 'template', messages: texts(compiled.takeError()) };
  // A warning, such as a font that is not there, would change the look in silence.
  const warnings = texts(compiled.takeWarnings());
  if (warnings.length > 0) return { status: 'refused', messages: warnings };
  let pdf;
  try {
    pdf = compiler.pdf(compiled.result, { pdfStandard: 'a-3a' });
  } catch (error) {
    const messages = messagesOf(error);
    const quoted = /the text `"((?:[^"\\]|\\.)*)"`/g;
    return { status: 'refused', messages, texts: messages.flatMap((text) => [...text.matchAll(quoted)].map((m) => m[1])) };
  }
  fs.writeFileSync(path.join(workspace, 'certificate.pdf'), pdf);
  return { status: 'done', memory: process.memoryUsage.rss() };
}

let answered = 0;
for await (const line of readline.createInterface({ input: process.stdin })) {
  let answer;
  try {
    const request = JSON.parse(line);
    answer = request.fonts ? fontsOf(request.fonts) : setDocument(request);
  } catch (error) {
    answer = { status: 'failed', messages: [String(error.message)], code: String(error.code ?? '') };
  }
  try {
    fs.writeSync(process.stdout.fd, JSON.stringify(answer) + '\n');
  } catch {
    break;  // nobody is there any more to read it
  }
  // Typst keeps what it has set, for all compilers together, and certificates have much in common: the same cells, sentences
  // and heads. While the other side reads the document, what some twenty documents did not use is forgotten; to look for it
  // takes as long as a page.
  if (++answered % 10 === 0) Object.values(compilers)[0]?.evictCache(2);
}
removeFolder();
process.exit();
