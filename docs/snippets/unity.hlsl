// Unity: antialiased halftone foam. Load the raw file once:
//   var texture = new Texture2D(256, 256, TextureFormat.R16, true, true); // mipmaps, linear
//   texture.filterMode = FilterMode.Point;
//   texture.wrapMode = TextureWrapMode.Repeat;
//   texture.SetPixelData(File.ReadAllBytes("mask.u16"), 0);
//   texture.Apply(true, true);
// HLSL, in the shader; uv counts repeats of the mask, foamSaturation is 0 to 1:
Texture2D _Mask;
SamplerState sampler_Mask; // the texture's own: point, repeat
static const float SPREAD[11] = { 0.0, 0.404, 0.471, 0.493, 0.499, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5 };

float Foam(float foamSaturation, float2 uv)
{
    float2 dx = ddx(uv), dy = ddy(uv), size;
    _Mask.GetDimensions(size.x, size.y);
    float side = 0.25 * sqrt(abs(dx.x * dy.y - dx.y * dy.x) * size.x * size.y);
    int level = (int)clamp(floor(log2(max(side, 1e-6)) + 0.5), 0.0, 10.0);
    float tilt = saturate(6.0 * SPREAD[level] - 1.5), bend = 6.0 * foamSaturation * (1.0 - foamSaturation), covered = 0.0;
    for (int i = 0; i < 16; i++)
    {
        float2 at = uv + dx * ((i & 3) - 1.5) / 4.0 + dy * ((i >> 2) - 1.5) / 4.0;
        float mean = _Mask.SampleLevel(sampler_Mask, at, level).r * (65535.0 / 65536.0) + 0.5 / 65536.0;
        float spread = max(min(SPREAD[level], min(mean, 1.0 - mean)), 1e-6);
        float even = saturate(0.5 + 0.5 * (foamSaturation - mean) / spread);
        covered += lerp(even, saturate(foamSaturation - bend * (mean - 0.5)), tilt);
    }
    return covered / 16.0;
}
