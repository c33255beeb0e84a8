// Opens and filters what is on the page already. Without it everything is shown.
"use strict";
for (const section of document.querySelectorAll(".findings")) {
  const tools = section.querySelector(".tools");
  const findings = [...section.querySelectorAll(".finding")];
  const choices = [...tools.querySelectorAll("[data-show]")];
  const fold = tools.querySelector(".fold");
  const status = tools.querySelector(".status");
  const show = (severity) => {
    let count = 0;
    for (const finding of findings) {
      finding.hidden = severity !== "all" && finding.dataset.severity !== severity;
      count += finding.hidden ? 0 : 1;
    }
    for (const choice of choices) {
      choice.setAttribute("aria-pressed", String(choice.dataset.show === severity));
    }
    status.textContent = status.dataset.text.replace("{count}", String(count));
  };
  for (const choice of choices) {
    choice.addEventListener("click", () => show(choice.dataset.show));
  }
  fold.addEventListener("click", () => {
    const open = fold.getAttribute("aria-expanded") !== "true";
    for (const details of section.querySelectorAll("details")) {
      details.open = open;
    }
    fold.setAttribute("aria-expanded", String(open));
    fold.textContent = open ? fold.dataset.close : fold.dataset.open;
  });
  // A link to a finding shows it, whatever is filtered.
  window.addEventListener("hashchange", () => {
    const target = findings.find((finding) => "#" + finding.id === location.hash);
    if (target && target.hidden) {
      show("all");
      target.scrollIntoView();
    }
  });
  tools.hidden = false;
}
// Paper has everything open.
window.addEventListener("beforeprint", () => {
  for (const details of document.querySelectorAll("details")) {
    details.open = true;
  }
});
