// Sets certificates as PDF/A-3a with Typst, one after the other, in a process that stays.
// Usage: node render.mjs NODE_MODULES WORKSPACE [FONT_FOLDER...]
//
// Each line of standard input is a request, JSON: {"template": "…/certificate.typ", "further_fonts": true|false}. The
// files of the document are in WORKSPACE: view.json, and certificate.xml if one is attached. The answer is one line of
// JSON on standard output:
//   {"status": "done", "memory": bytes}                      WORKSPACE/certificate.pdf is there
//   {"status": "template", "messages": ["…"]}                the template cannot be set
//   {"status": "refused", "messages": ["…"]}                 what it gives is no PDF/A-3a
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

// The compiler keeps its fonts. Opening further folders takes time, so it is done for the first document that asks.
const compilers = {};
function compilerWith(furtherFonts) {
  const fontArgs = furtherFonts && fontFolders.length > 0 ? { fontArgs: [{ fontPaths: fontFolders }] } : {};
  return (compilers[furtherFonts] ??= NodeCompiler.create({ workspace, ...fontArgs }));
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
  const compiler = compilerWith(furtherFonts === true);
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
    return { status: 'refused', messages: messagesOf(error) };
  }
  fs.writeFileSync(path.join(workspace, 'certificate.pdf'), pdf);
  return { status: 'done', memory: process.memoryUsage.rss() };
}

for await (const line of readline.createInterface({ input: process.stdin })) {
  let answer;
  try {
    answer = setDocument(JSON.parse(line));
  } catch (error) {
    answer = { status: 'failed', messages: [String(error.message)], code: String(error.code ?? '') };
  }
  fs.writeSync(process.stdout.fd, JSON.stringify(answer) + '\n');
  // While the other side reads the document, what the last three did not use is forgotten.
  for (const compiler of Object.values(compilers)) compiler.evictCache(3);
}
removeFolder();
