/** Editing of the scene's fields: the settings' pane and the split view of one field. What they need is loaded on first use. */
import type { Api, SceneSchema } from "../api";
import { choiceControls, labelOf, ListedOptions, sceneControls } from "../panel/model";
import type { ScenePane } from "../panel/pane";
import { isObject, type Json, withValue } from "../scene/json";
import { type ComparableField, preferredField, QUALITY_FIELD, qualityTitle, splitAfterEdit, startSplit, type Store, validSplit } from "../selection/selection";
import { SplitView } from "../ui/splitview";

/** `tiers`: names of the quality tiers, once they are known. */
interface SceneEditorEvents { tiers(names: readonly string[]): void; failed(error: unknown): void; }

export class SceneEditor {
  private pane: ScenePane | null = null;
  private schema: SceneSchema | null = null;
  private schemaLoading: Promise<void> | null = null;
  private readonly splitView: SplitView;
  private readonly options: ListedOptions;

  constructor(
    private readonly api: Api,
    private readonly store: Store,
    private readonly paneContainer: HTMLElement,
    splitContainer: HTMLElement,
    private readonly events: SceneEditorEvents,
  ) {
    this.options = new ListedOptions((url) => api.choices(url), () => this.show(true), (error) => events.failed(error));
    this.splitView = new SplitView(splitContainer, (split) => store.set({ split }), (field) => this.compareBy(field));
  }

  load(): void {
    if (this.pane) return;
    void this.withSchema();
    import("../panel/pane").then(
      ({ ScenePane: Pane }) => {
        this.pane ??= new Pane(this.paneContainer, {
          change: (pointer, value) => this.edit(pointer, value),
          optionsFrom: (url) => this.options.from(url),
        });
        this.show();
      },
      (error: unknown) => this.events.failed(error),
    );
  }

  /** Shows the selection; `rebuild`: the options of the pane's fields have changed. */
  show(rebuild = false): void {
    const { scene, split } = this.store.now;
    if (split) void this.withSchema();
    const controls = this.pane && this.schema && sceneControls(this.schema, scene);
    if (controls) this.pane?.show(controls, scene, rebuild);
    this.splitView.show(split, split ? this.comparableFields() : []);
  }

  async toggleSplit(): Promise<void> {
    await this.withSchema();
    const { now } = this.store;
    const preferred = now.split ? undefined : preferredField(this.comparableFields());
    this.store.set({ split: preferred ? startSplit(now, preferred) : null });
  }

  /** Settles when the schema is here, or could not be loaded and may be tried again. */
  private withSchema(): Promise<void> {
    this.schemaLoading ??= this.api.schema().then(
      (schema) => {
        this.schema = schema;
        this.events.tiers(schema.tiers);
        this.show();
      },
      (error: unknown) => {
        this.schemaLoading = null;
        this.events.failed(error);
      },
    );
    return this.schemaLoading;
  }

  private compareBy(name: string): void {
    const comparable = this.comparableFields().find(({ field }) => field === name);
    if (comparable) this.store.set({ split: startSplit(this.store.now, comparable) });
  }

  private edit(pointer: string, value: Json): void {
    const { scene: before, split } = this.store.now;
    const scene = withValue(before, pointer, value);
    if (isObject(scene)) this.store.set({ scene, split: validSplit(scene, splitAfterEdit(split, pointer, value)) });
  }

  /** Every choice of the scene, and the quality. */
  private comparableFields(): ComparableField[] {
    const { scene, quality } = this.store.now;
    const controls = this.schema && sceneControls(this.schema, scene);
    const fields = (controls ? choiceControls(controls) : []).map((control) => ({
      field: control.pointer,
      title: control.label,
      options: control.kind === "choice" ? control.options.map((name) => ({ name, title: labelOf(name) })) : this.options.from(control.url),
    }));
    const qualities = [...new Set([...(this.schema?.tiers ?? []), quality])].map((name) => ({ name, title: qualityTitle(name) }));
    return [...fields, { field: QUALITY_FIELD, title: "quality", options: qualities }];
  }
}
