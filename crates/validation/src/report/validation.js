// Chooses among the cases, and opens a case that a link leads to. The page says everything without it.
(() => {
  "use strict";
  const filter = document.getElementById("filter");
  const rows = [...document.querySelectorAll(".overview tr[data-verdict], details.case")];
  const headings = [...document.querySelectorAll(".overview tr.group")];

  function choose() {
    const verdicts = new Set([...filter.querySelectorAll("input:checked")].map((box) => box.value));
    const group = filter.querySelector("select").value;
    const wanted = ({ dataset }) => verdicts.has(dataset.verdict) && (group === "" || dataset.group === group);
    for (const row of rows) row.hidden = !wanted(row);
    for (const heading of headings) {
      heading.hidden = !rows.some((row) => !row.hidden && row.dataset.group === heading.dataset.group);
    }
  }

  function openTarget() {
    const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
    if (!(target instanceof HTMLDetailsElement)) return;
    target.hidden = false;
    target.open = true;
    target.scrollIntoView();
  }

  if (filter) {
    filter.hidden = false;
    filter.addEventListener("input", choose);
  }
  addEventListener("hashchange", openTarget);
  openTarget();
})();
