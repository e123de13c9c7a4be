/** A Tweakpane control for numbers whose range spans many decades: the slider is logarithmic, the text is the number. */
import {
  type BaseInputParams,
  connectValues,
  createNumberFormatter,
  createPlugin,
  createRangeConstraint,
  createValue,
  type InputBindingPlugin,
  NumberTextController,
  numberFromUnknown,
  parseNumber,
  SliderController,
  SliderTextView,
  type Value,
  type ValueController,
  ValueMap,
  type ViewProps,
  writePrimitive,
} from "@tweakpane/core";

interface LogParams extends BaseInputParams {
  view: "log";
  min: number;
  max: number;
  format?: (value: number) => string;
}

class LogSliderController implements ValueController<number, SliderTextView> {
  readonly view: SliderTextView;

  constructor(
    document: Document,
    readonly value: Value<number>,
    readonly viewProps: ViewProps,
    params: LogParams,
  ) {
    const [low, high] = [Math.log10(params.min), Math.log10(params.max)];
    const clampedLog = (x: number) => Math.min(high, Math.max(low, Math.log10(Math.max(x, params.min))));
    const logarithm = createValue(clampedLog(value.rawValue));
    connectValues({
      primary: value,
      secondary: logarithm,
      forward: clampedLog,
      // Three digits are as fine as a slider can be set.
      backward: (log) => Number((10 ** log).toPrecision(3)),
    });
    const slider = new SliderController(document, {
      props: ValueMap.fromObject({ keyScale: (high - low) / 100, min: low, max: high }),
      value: logarithm,
      viewProps,
    });
    const text = new NumberTextController(document, {
      parser: parseNumber,
      props: ValueMap.fromObject({
        formatter: params.format ?? createNumberFormatter(3),
        keyScale: 1,
        pointerScale: Math.max(params.min, Math.abs(value.rawValue) / 50),
      }),
      value,
      viewProps,
    });
    this.view = new SliderTextView(document, { sliderView: slider.view, textView: text.view });
  }
}

export const logSlider: InputBindingPlugin<number, number, LogParams> = createPlugin({
  id: "log-slider",
  type: "input",
  accept: (value, params) =>
    typeof value === "number" && params["view"] === "log" ? { initialValue: value, params: params as unknown as LogParams } : null,
  binding: {
    reader: () => numberFromUnknown,
    constraint: ({ params }) => {
      const range = createRangeConstraint(params);
      return { constrain: (value: number) => range?.constrain(value) ?? value };
    },
    writer: () => writePrimitive,
  },
  controller: ({ document, value, viewProps, params }) => new LogSliderController(document, value, viewProps, params),
});
