/** "Take home": everything that leaves the page, for the current scene and frame. */
import { useSignal } from "@preact/signals";
import { render } from "preact";
import type { SurfaceContext } from "../surfaces/context";
import { CodeBlock, Head, TaskButton, useChanges } from "../surfaces/parts";
import { download } from "../ui/dom";
import { curl, exactFrame, frameBody, javascript, python, requestOf } from "./snippets";

const LANGUAGES = { curl, Python: python, JavaScript: javascript };
type Language = keyof typeof LANGUAGES;

function Frame({ context }: { context: SurfaceContext }) {
  const recipe = useSignal(context.recipe());
  const language = useSignal<Language>("curl");
  const update = () => {
    recipe.value = context.recipe();
  };
  // A moving picture would change the text while it is read.
  useChanges(context, () => context.playing() || update());
  const { time, width, height } = recipe.value;
  const request = requestOf(recipe.value, context.selection().preset, document.baseURI);
  return (
    <section>
      <h3>This frame from the server</h3>
      <p>
        Exactly the frame at {time.toFixed(2)} s, {width} × {height} pixels: the same request gives the same bytes.
      </p>
      <div class="pills" role="group" aria-label="Language">
        {(Object.keys(LANGUAGES) as Language[]).map((name) => (
          <button type="button" class="pill" key={name} aria-pressed={name === language.value} onClick={() => (language.value = name)}>
            {name}
          </button>
        ))}
        <button type="button" class="pill" onClick={update}>
          Take the current frame
        </button>
      </div>
      <CodeBlock label={language.value} text={LANGUAGES[language.value](request)} failed={context.failed} />
    </section>
  );
}

function Pictures({ context }: { context: SurfaceContext }) {
  const { failed } = context;
  const server = () => context.api.frame(exactFrame(context.recipe()));
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
        <TaskButton run={() => context.save(context.png(), "")} failed={failed}>
          PNG, drawn here
        </TaskButton>
        <TaskButton run={() => context.save(server(), "-server")} failed={failed}>
          PNG, drawn by the server
        </TaskButton>
        <label class="file pill relative overflow-hidden focus-within:outline-2 focus-within:outline-offset-2 focus-within:outline-accent">
          Restore from a picture
          <input type="file" class="pointer-events-none absolute inset-0 w-full opacity-0" accept="image/png,image/webp,.exr" onChange={(event) => picked(event.currentTarget)} />
        </label>
        <TaskButton run={() => context.copyLink()} failed={failed}>
          Copy link
        </TaskButton>
      </div>
    </section>
  );
}

function Archive({ context }: { context: SurfaceContext }) {
  const pack = async () => {
    const { preset, ...body } = frameBody(context.recipe());
    download(await context.api.archive({ ...body, preset }), `seafoam-${preset ?? "scene"}.zip`);
  };
  return (
    <section>
      <h3>Zip that runs by itself</h3>
      <p>Page, player, frame plan, GLSL, textures and uniforms of this scene. Unpack it and open index.html: no server, no network.</p>
      <div class="pills">
        <TaskButton run={pack} failed={context.failed}>
          Zip
        </TaskButton>
      </div>
    </section>
  );
}

function Element({ context }: { context: SurfaceContext }) {
  const { preset, quality } = context.selection();
  const tier = quality.startsWith("{") ? "standard" : quality;
  const html = [
    `<script type="module" src="/seafoam-water.js"></script>`,
    `<seafoam-water preset="${preset.name}" time="${context.time().toFixed(2)}" quality="${tier}" server="/"></seafoam-water>`,
  ].join("\n");
  return (
    <section>
      <h3>Element for a page of your own</h3>
      <p>The preset, without changes to its scene. The package is webclient/element; its README lists the attributes.</p>
      <CodeBlock label="HTML" text={html} failed={context.failed} />
    </section>
  );
}

function TakeHome({ context }: { context: SurfaceContext }) {
  return (
    <>
      <Head title="Take home" close={() => context.close()} />
      <Archive context={context} />
      <Pictures context={context} />
      <Frame context={context} />
      <Element context={context} />
    </>
  );
}

export function mount(root: HTMLElement, context: SurfaceContext): () => void {
  render(<TakeHome context={context} />, root);
  return () => render(null, root);
}
