/** "Take home": everything that leaves the page, for the current scene and frame. */
import { useSignal } from "@preact/signals";
import type { PageContext } from "../surfaces/context";
import { CodeBlock, Head, Pills, TaskButton, useChanges } from "../surfaces/parts";
import { download } from "../ui/dom";
import { curl, frameBody, javascript, python, requestOf } from "./recipe";

const LANGUAGES = { curl, Python: python, JavaScript: javascript };
type Language = keyof typeof LANGUAGES;

function Frame({ context }: { context: PageContext }) {
  const recipe = useSignal(context.view());
  const language = useSignal<Language>("curl");
  const update = () => (recipe.value = context.view());
  // A moving picture would change the text while it is read.
  useChanges(context, () => context.clock.playing || update());
  const { time, width, height } = recipe.value;
  const request = requestOf(recipe.value, context.store.now.preset, document.baseURI);
  return (
    <section>
      <h3>This frame from the server</h3>
      <p>Exactly the frame at {time.toFixed(2)} s, {width} × {height} pixels: the same request gives the same bytes.</p>
      <div class="pills" role="group" aria-label="Language">
        <Pills names={Object.keys(LANGUAGES) as Language[]} chosen={language.value} choose={(name) => (language.value = name)} />
        <button type="button" class="pill" onClick={update}>Take the current frame</button>
      </div>
      <CodeBlock label={language.value} text={LANGUAGES[language.value](request)} failed={context.options.failed} />
    </section>
  );
}

function Pictures({ context }: { context: PageContext }) {
  const { failed, copyLink } = context.options;
  const picked = (input: HTMLInputElement) => {
    const [file] = input.files ?? [];
    if (file) context.restore(file).catch(failed);
    input.value = "";
  };
  return (
    <section>
      <h3>Picture with its recipe</h3>
      <p>
        The PNG carries scene, quality, camera and time, as the server's WebP and OpenEXR files do. Drop such a picture on this page, or choose it
        here, and the view is restored.
      </p>
      <div class="pills">
        <TaskButton run={() => context.save(context.png(), "")} failed={failed}>PNG, drawn here</TaskButton>
        <TaskButton run={() => context.save(context.serverFrame(), "-server")} failed={failed}>
          PNG, drawn by the server
        </TaskButton>
        <label class="file pill relative overflow-hidden focus-within:outline-2 focus-within:outline-offset-2 focus-within:outline-accent">
          Restore from a picture
          <input type="file" class="pointer-events-none absolute inset-0 w-full opacity-0" accept="image/png,image/webp,.exr" onChange={(event) => picked(event.currentTarget)} />
        </label>
        <TaskButton run={copyLink} failed={failed}>Copy link</TaskButton>
      </div>
    </section>
  );
}

function Archive({ context }: { context: PageContext }) {
  const pack = async () => {
    const request = frameBody(context.view());
    download(await context.api.archive(request), `seafoam-${request.preset ?? "scene"}.zip`);
  };
  return (
    <section>
      <h3>Zip that runs by itself</h3>
      <p>Page, player, frame plan, GLSL, textures and uniforms of this scene. Unpack it and open index.html: no server, no network.</p>
      <div class="pills"><TaskButton run={pack} failed={context.options.failed}>Zip</TaskButton></div>
    </section>
  );
}

function Element({ context }: { context: PageContext }) {
  const { preset, quality } = context.store.now;
  const tier = quality.startsWith("{") ? "standard" : quality;
  const html = [
    `<script type="module" src="/seafoam-water.js"></script>`,
    `<seafoam-water preset="${preset.name}" time="${context.clock.time.toFixed(2)}" quality="${tier}" server="/"></seafoam-water>`,
  ].join("\n");
  return (
    <section>
      <h3>Element for a page of your own</h3>
      <p>The preset, without changes to its scene. The package is webclient/element; its README lists the attributes.</p>
      <CodeBlock label="HTML" text={html} failed={context.options.failed} />
    </section>
  );
}

export function Surface({ context }: { context: PageContext }) {
  return (
    <>
      <Head title="Take home" close={context.options.close} />
      <Archive context={context} />
      <Pictures context={context} />
      <Frame context={context} />
      <Element context={context} />
    </>
  );
}
