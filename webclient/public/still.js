// Shows the preset's still at once if the link is to the preset's start. Runs before the page is complete.
{
  const link = new URLSearchParams(location.hash.slice(1));
  const { preset, stills } = document.documentElement.dataset;
  const name = link.get("preset") ?? preset;
  const start = ["scene", "time", "camera", "split"].every((part) => !link.has(part));
  // Not in windows wider than the still (12 : 5).
  if (start && stills.split(" ").includes(name) && 5 * innerWidth <= 12 * innerHeight) {
    const still = document.getElementById("still");
    const hide = () => {
      document.documentElement.classList.remove("still");
      still.hidden = true;
    };
    document.documentElement.classList.add("still");
    still.addEventListener("error", hide, { once: true });
    still.src = `./stills/${name}.avif`;
    still.hidden = false;
  }
}
