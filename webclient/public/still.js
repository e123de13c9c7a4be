// Asks for the preset's still before anything else if the link is to the preset's start, and shows it as soon as the page has
// the place for it. In the head: scripts behind the style sheets wait for them.
{
  const root = document.documentElement;
  const link = new URLSearchParams(location.hash.slice(1));
  const { preset, stills } = root.dataset;
  const name = link.get("preset") ?? preset;
  const start = ["scene", "time", "camera", "split"].every((part) => !link.has(part));
  // Not in windows wider than the still (12 : 5).
  if (start && stills.split(" ").includes(name) && 5 * innerWidth <= 12 * innerHeight) {
    const href = `./stills/${name}.avif`;
    root.classList.add("still");
    document.head.append(Object.assign(document.createElement("link"), { rel: "preload", as: "image", type: "image/avif", fetchPriority: "high", href }));
    const show = () => {
      const still = document.getElementById("still");
      const hide = () => {
        root.classList.remove("still");
        still.hidden = true;
      };
      still.addEventListener("error", hide, { once: true });
      still.src = href;
      still.hidden = false;
    };
    // The page is parsed, and its modules have not run.
    document.addEventListener("readystatechange", show, { once: true });
  }
}
